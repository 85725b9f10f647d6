// Choices and buttons: each tells the walks one thing, and shows what walks now.
let known = []; // names of the walk and of its ghost
const names = Object.keys(scene.numbers.walks);
function showNames(given) {
  known = given;
  element("walk").value = known[0];
  element("ghost").value = known.length > 1 ? known[1] : "";
}
for (const id of ["walk", "ghost"]) element(id).append(...names.map((name) => new Option(name, name)));

// what was refused is forgotten with the next thing that is done
const complain = (sentence) => { element("refused").textContent = sentence; };
const act = (message) => { complain(""); send(message); };

const RATES = [0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10];
let rate = 1, paused = false;
function faster(by) {
  const k = RATES.findIndex((x) => x >= rate * (1 - 1e-9)) + by;
  rate = RATES[Math.min(Math.max(k, 0), RATES.length - 1)]; // for a second press before the next frame
  send({ do: "go_at", rate });
}
// numbers of the hand; what is none is said, and nothing is done
function handed(fields, message) {
  const found = fields.map((field) => element(field).valueAsNumber);
  const wrong = fields.filter((_, k) => !Number.isFinite(found[k]));
  if (wrong.length) complain("the hand's " + wrong.join(" and ") + " is no number");
  else act({ do: "push", ...message(...found) });
}
function pushJoint(sign) {
  handed(["torque", "seconds"], (torque, seconds) => ({ torque: { [element("joint").value]: sign * torque }, seconds }));
}
function shove(sign) {
  const link = element("link").value, at = selected && selected.link === link ? selected.at : [0, 0];
  handed(["shove", "seconds"], (force, seconds) => ({ link, at, force: [sign * force, 0], seconds }));
}
const toggle = () => send({ do: paused ? "go" : "pause" });
const ACTIONS = {
  play: toggle,
  step: () => send({ do: "step" }),
  back: () => act({ do: "back" }),
  reset: () => act({ do: "reset" }),
  slower: () => faster(-1),
  faster: () => faster(1),
  view: () => look(view === "side" ? "perspective" : "side"),
  help: () => (element("keys").open ? element("keys").close() : element("keys").showModal()),
  "torque-minus": () => pushJoint(-1),
  "torque-plus": () => pushJoint(1),
  "shove-back": () => shove(-1),
  "shove-on": () => shove(1),
  pull: () => {
    const pressed = element("pull").getAttribute("aria-pressed") !== "true";
    element("pull").setAttribute("aria-pressed", String(pressed));
  },
};
for (const [id, act] of Object.entries(ACTIONS)) element(id).onclick = act;
element("walk").onchange = (event) => act({ do: "reset", walk: event.target.value });
element("ghost").onchange = (event) => act({ do: "ghost", walk: event.target.value || null });
element("plotted").onchange = (event) => { joint = event.target.selectedIndex; drawPlots(); };
element("close-keys").onclick = () => element("keys").close();
