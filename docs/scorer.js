// pages whose title has the words of the query come first, how-to pages before names of the reference
var Scorer = {
  objNameMatch: 6, objPartialMatch: 2, objPrio: {0: 2, 1: 1, 2: -5}, objPrioDefault: 0,
  title: 15, partialTitle: 7, term: 5, partialTerm: 2,
  score: ([page, title, anchor, , score]) => {
    const words = new URLSearchParams(window.location.search).get("q").toLowerCase().split(/\s+/);
    if (words.every((word) => title.toLowerCase().includes(word))) score += anchor ? 50 : 100;
    if (/^(extend|guide)\//.test(page)) score += 20;
    return page.startsWith("api/") ? score - 20 : score;
  },
};
