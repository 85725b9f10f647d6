// The page: frames, keys, and the line that says how the walk is.
const STAYS = 600; // [ms] for which a breach of a limit can be read
let breach = { words: "", until: 0 };

// of all samples since the frame before
function breachOf({ worst }) {
  if (!worst) return "";
  const { friction, torque } = scene.limits;
  if (worst.normal !== null && worst.normal <= 0) return "the ground would have to pull the foot";
  if (worst.friction > friction) return "friction " + worst.friction.toFixed(2) + " > " + friction;
  return worst.torque > torque * (1 + 1e-9) ? "torque " + worst.torque.toFixed(0) + " > " + torque + " N m" : "";
}
// words, timeline and plots no more often than they can be read, so that the robot has the time
const READ = 80; // [ms]
let asked = false; // whether the next picture of them is on its way
function drawBeside() {
  if (asked || page.last === null) return;
  asked = true;
  setTimeout(() => {
    asked = false;
    describe(page.last);
    drawPlots(page.last.t);
  }, READ);
}
function describe(message) {
  const [walk, ghost] = message.walks, now = performance.now();
  element("clock").textContent = "t = " + message.t.toFixed(2) + " s, step " + walk.support.number;
  const slow = !message.paused && message.reached < 0.9 * message.rate;
  element("rate").textContent = message.rate + " x" + (message.paused ? ", paused" : "")
    + (slow ? ", reached " + message.reached.toFixed(2) + " x" : "");
  const words = now < breach.until ? "beyond its limits: " + breach.words : "within its limits";
  element("limits").textContent = walk.ending ? "" : words;
  element("limits").className = now < breach.until ? "bad" : "good";
  const ends = [["walk", walk], ["ghost", ghost]].filter(([, w]) => w && w.ending);
  tell(ends.map(([name, w]) => name + " " + w.ending).join(". "));
  element("up").hidden = !walk.ending;
  element("play").textContent = message.paused ? "go" : "pause";
  [, element("timeline").max] = message.timeline; // before the value, which it bounds
  [element("timeline").value] = message.timeline;
}
function tell(words) {
  if (element("ended").textContent !== words) element("ended").textContent = words;
  element("message").hidden = words === "";
}

function showFrame(frame) {
  ({ rate, paused } = frame);
  scene.limits = frame.limits;
  const words = breachOf(frame.walks[0]);
  if (words) breach = { words, until: performance.now() + STAYS };
  page.last = frame;
  drawWalks(frame);
  remember(frame);
  drawBeside();
  keepPulling();
  page.frames += 1;
}
// what keys, fields and the mouse ask of the walks, such as { do: "push", torque: { q1: 30 } }
function send({ do: word, ...values }) {
  if (play === null) return;
  try {
    play[word](values);
  } catch (error) {
    complain(error.message);
  }
  play.news = true;
}
// at rest nothing is drawn, but what was said of a breach goes
function turn(now) {
  play.advance(now);
  if (play.news || now < breach.until + STAYS) showFrame(play.frame());
  if (viewer.needs_render) viewer.render();
  requestAnimationFrame(turn);
}
const page = { last: null, frames: 0 };
let play = null;
startMachine().then(() => {
  play = new Play(numbers.first, numbers.ghost);
  turn(performance.now());
}).catch((error) => tell("This page cannot walk here: " + error.message));

const KEYS = {
  " ": toggle, ArrowRight: ACTIONS.step, Backspace: ACTIONS.reset, b: ACTIONS.back, u: ACTIONS.up, s: save,
  "-": ACTIONS.slower, "+": ACTIONS.faster, "=": ACTIONS.faster, v: ACTIONS.view,
  "?": ACTIONS.help, t: tour, n: () => { if (station >= 0) goTo(station + 1); }, p: pushOnce,
  f: ACTIONS["shove-on"], r: ACTIONS["shove-back"], Escape: () => { release(); select(null); decline(); },
};
// of a field and of a slider only the keys that are its own
function takes({ tagName, type }, key) {
  if (tagName === "INPUT" && type === "number") return key !== "Escape";
  if (tagName === "INPUT" || tagName === "SELECT") return key.startsWith("Arrow") || (tagName === "SELECT" && key === " ");
  return tagName === "BUTTON" && key === " ";
}
document.addEventListener("keydown", (event) => {
  const other = event.ctrlKey || event.metaKey || event.altKey; // a shortcut of the browser's
  if (other || takes(event.target, event.key) || !(event.key in KEYS)) return;
  if (element("keys").open && event.key !== "?") return;
  event.preventDefault();
  KEYS[event.key]();
});
viewer.gui.close();
// the tour and long sentences take room from the picture
new ResizeObserver(() => { viewer.set_3d_pane_size(); viewer.render(); }).observe(pane);
look(scene.view);
