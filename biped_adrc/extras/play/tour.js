// The guided tour: each station sets the walk, may push it, and says what to look at.
let station = -1, timers = [], before = null; // before: what walked

function leaveTour() {
  timers.forEach(clearTimeout);
  timers = [];
  station = -1;
  element("tour").hidden = true;
  act({ do: "reset", walk: before });
  send({ do: "go_at", rate: 1 });
}
function goTo(k) {
  if (k < 0 || k >= scene.tour.length) { leaveTour(); return; }
  timers.forEach(clearTimeout);
  decline();
  const s = scene.tour[k];
  if (station < 0) [before] = known;
  station = k;
  element("tour").hidden = false;
  element("tour-title").textContent = k + 1 + " of " + scene.tour.length + ": " + s.title;
  element("tour-text").textContent = s.text;
  const inside = location.pathname.includes("/_static/"), address = s.page + (inside ? ".html" : ".md");
  element("tour-page").textContent = "docs/" + address;
  if (inside) element("tour-page").href = "../" + address;
  element("tour-next").textContent = k + 1 < scene.tour.length ? "next (n)" : "end (n)";
  element("tour-title").focus();
  act({ do: "let_go" });
  send({ do: "reset", walk: s.walk });
  send({ do: "go_at", rate: s.rate });
  send({ do: "go" });
  if (s.push) timers = [setTimeout(pushAgain, 1000 * s.after / s.rate)];
}
const pushAgain = () => send({ do: "push", ...scene.tour[station].push });
// in the tour the push of the station, else that of the buttons
const pushOnce = () => (station >= 0 && scene.tour[station].push ? pushAgain() : pushJoint(1));
const tour = () => (station < 0 ? goTo(0) : leaveTour());
const decline = () => { element("invitation").hidden = true; };
element("start-tour").onclick = tour;
element("take-tour").onclick = tour;
element("no-tour").onclick = decline;
element("tour-next").onclick = () => goTo(station + 1);
element("tour-before").onclick = () => goTo(Math.max(station - 1, 0));
element("tour-again").onclick = () => goTo(station);
element("tour-leave").onclick = leaveTour;
