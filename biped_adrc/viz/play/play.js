// The page of a live walk: messages from the session, keys, and the line that says how it is.
const STAYS = 600; // [ms] for which a breach of a limit can be read
const SILENCE = 5000; // [ms] without a message after which the server is said to be silent
let breach = { words: "", until: 0 };

// of all samples since the last message
function breachOf({ worst }) {
  if (!worst) return "";
  const { friction, torque } = scene.limits, rigid = worst.slips === null;
  if (worst.slips) return "a foot slips";
  if (rigid && worst.normal !== null && worst.normal <= 0) return "the ground would have to pull the foot";
  if (rigid && worst.friction > friction) return "friction " + worst.friction.toFixed(2) + " > " + friction;
  return worst.torque > torque * (1 + 1e-9) ? "torque " + worst.torque.toFixed(0) + " > " + torque + " N m" : "";
}
function describe(message) {
  const [walk, ghost] = message.walks, now = performance.now(), found = breachOf(walk);
  if (found) breach = { words: found, until: now + STAYS };
  element("clock").textContent = "t = " + message.t.toFixed(2) + " s, step " + walk.support.number;
  const slow = !message.paused && message.reached < 0.9 * message.rate;
  element("rate").textContent = message.rate + " x" + (message.paused ? ", paused" : "")
    + (slow ? ", reached " + message.reached.toFixed(2) + " x" : "");
  const words = now < breach.until ? "not legal now: " + breach.words : "legal now";
  element("legal").textContent = walk.ending ? "" : words;
  element("legal").className = now < breach.until ? "bad" : "good";
  const ends = [["walk", walk], ["ghost", ghost]].filter(([, w]) => w && w.ending);
  tell(ends.map(([name, w]) => name + " " + w.ending).join(". "));
}
function tell(words) {
  if (over) return;
  if (element("message").textContent !== words) element("message").textContent = words;
  element("message").hidden = words === "";
}

function hear(message) {
  if (message.over) { tell(message.over); over = true; }
  else if (message.values) showValues(message.values);
  else if (message.refused) refuse(message);
  else if (message.saved) element("said").textContent = "saved as " + message.saved.join(" and ");
  else if (message.remark) element("said").textContent = message.remark;
  else if (message.walks) {
    ({ rate, paused } = message);
    scene.limits = message.limits;
    element("play").textContent = paused ? "go" : "pause";
    drawWalks(message);
    remember(message);
    drawPlots();
    describe(message);
    keepPulling();
    page.last = message;
  }
}

const page = { frames: 0, last: null, text: "", heard: performance.now() };
let over = false;
const socket = scene.offline ? new OfflineSocket() : new WebSocket("ws://" + location.host + "/poses");
const send = (message) => { if (socket.readyState === WebSocket.OPEN) socket.send(JSON.stringify(message)); };
socket.onmessage = ({ data }) => {
  page.frames += 1;
  page.heard = performance.now();
  if (data !== page.text) hear(JSON.parse(data)); // at rest nothing is drawn
  page.text = data;
};
let silent = false;
setInterval(() => {
  const since = performance.now() - page.heard, was = silent;
  silent = !scene.offline && since > SILENCE; // a page that nobody sees rests
  if (silent) tell("The server has said nothing for " + (since / 1000).toFixed(0) + " s: it computes, or has stopped.");
  else if (was && page.last) describe(page.last);
}, 1000);
socket.onclose = () => tell("The session has ended: this picture no longer moves. Start it again with 'biped-adrc play'.");

const KEYS = {
  " ": toggle, ArrowRight: ACTIONS.step, Backspace: ACTIONS.reset, b: ACTIONS.back,
  "-": ACTIONS.slower, "+": ACTIONS.faster, "=": ACTIONS.faster, v: ACTIONS.view, s: ACTIONS.save,
  "?": ACTIONS.help, t: tour, n: () => { if (station >= 0) goTo(station + 1); }, p: pushOnce,
  f: ACTIONS["shove-on"], r: ACTIONS["shove-back"], Escape: () => { release(); select(null); decline(); },
};
document.addEventListener("keydown", (event) => {
  const { tagName } = event.target, writes = ["INPUT", "SELECT", "TEXTAREA"].includes(tagName);
  const presses = tagName === "BUTTON" && event.key === " ";
  const other = (event.ctrlKey || event.metaKey) && !pull; // a shortcut of the browser's
  if (other || event.altKey || writes || presses || !(event.key in KEYS)) return;
  if (element("keys").open && event.key !== "?") return;
  event.preventDefault();
  KEYS[event.key]();
});
viewer.gui.close();
// the tour and long sentences take room from the picture
new ResizeObserver(() => { viewer.set_3d_pane_size(); viewer.set_dirty(); }).observe(pane);
look(scene.view);
