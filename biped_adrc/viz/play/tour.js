// The guided tour: each station sets the walk, may push it, and says what to look at.
let station = -1, timers = [];

function leaveTour() {
  timers.forEach(clearTimeout);
  timers = [];
  station = -1;
  element("tour").hidden = true;
}
function goTo(k) {
  if (k < 0 || k >= scene.tour.length) { leaveTour(); return; }
  timers.forEach(clearTimeout);
  station = k;
  const s = scene.tour[k];
  element("tour").hidden = false;
  element("tour-title").textContent = k + 1 + " of " + scene.tour.length + ": " + s.title;
  element("tour-text").textContent = s.text;
  element("tour-page").textContent = "Read on in the documentation: " + s.page;
  element("tour-next").textContent = k + 1 < scene.tour.length ? "next (n)" : "end (n)";
  element("tour-title").focus();
  for (const message of [{ do: "let_go" }, { do: "change", values: s.values }, { do: "reset" }, { do: "rate", rate: s.rate }, { do: "go" }]) {
    send(message);
  }
  if (s.push) timers = [setTimeout(pushAgain, 1000 * s.after / s.rate)];
}
const pushAgain = () => { if (station >= 0 && scene.tour[station].push) send({ do: "push", ...scene.tour[station].push }); };
const tour = () => (station < 0 ? goTo(0) : leaveTour());
element("start-tour").onclick = tour;
element("tour-next").onclick = () => goTo(station + 1);
element("tour-before").onclick = () => goTo(Math.max(station - 1, 0));
element("tour-again").onclick = () => goTo(station);
element("tour-leave").onclick = leaveTour;
