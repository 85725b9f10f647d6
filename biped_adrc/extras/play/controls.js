// Choices, buttons and sliders: each tells the walks one thing, and shows what walks now.
let known = []; // names of the walk and of its ghost
const names = Object.keys(scene.numbers.walks);
function showNames(current) {
  if (current[0] !== known[0]) showSliders(current[0]);
  known = current;
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
// what was done, into the folder of downloads
function save() {
  complain("");
  try {
    const link = document.createElement("a");
    link.href = URL.createObjectURL(new Blob([scenarioText(play)], { type: "application/toml" }));
    link.download = "by_hand.toml";
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 1000);
  } catch (error) {
    complain(error.message);
  }
}
const ACTIONS = {
  play: toggle, save,
  step: () => send({ do: "step" }),
  back: () => act({ do: "back" }),
  up: () => { act({ do: "back" }); send({ do: "back" }); send({ do: "go" }); },
  reset: () => act({ do: "reset" }),
  slower: () => faster(-1),
  faster: () => faster(1),
  view: () => look(view === "side" ? "perspective" : "side"),
  help: () => (element("keys").open ? element("keys").close() : element("keys").showModal()),
  "torque-minus": () => pushJoint(-1),
  "torque-plus": () => pushJoint(1),
  "shove-back": () => shove(-1),
  "shove-on": () => shove(1),
};
for (const [id, act] of Object.entries(ACTIONS)) element(id).onclick = act;
element("walk").onchange = (event) => act({ do: "reset", walk: event.target.value });
element("ghost").onchange = (event) => act({ do: "ghost", walk: event.target.value || null });
element("plotted").onchange = (event) => { joint = event.target.selectedIndex; drawBeside(); };
element("close-keys").onclick = () => element("keys").close();
element("timeline").oninput = (event) => { act({ do: "pause" }); send({ do: "scrub", place: event.target.valueAsNumber }); };
document.addEventListener("change", (event) => event.target.blur()); // keys are for the walk again

// -- sliders -----------------------------------------------------------------------------------------
const WAYS = 1000; // places of a slider
function placeOn({ low, high, log, table }, x) {
  if (table.length) return table.indexOf(x);
  return Math.round(WAYS * (log ? Math.log(x / low) / Math.log(high / low) : (x - low) / (high - low)));
}
function valueOn({ low, high, log, table }, k) {
  if (table.length) return table[k];
  const s = k / WAYS, x = log ? low * (high / low) ** s : low + s * (high - low);
  return s === 0 ? low : s === 1 ? high : Number(x.toPrecision(log ? 2 : 3));
}
const short = (x) => Number(x.toPrecision(6));
function showSliders(name) {
  const { sliders } = numbers.walks[name];
  element("sliders").replaceChildren(...sliders.map((one) => sliderOf(name, one)));
}
function sliderOf(name, one) {
  const row = document.createElement("div"), words = one.name.split(".").at(-1).replace("_limit", " limit");
  const label = (one.name === FRICTION ? "joint friction" : words) + (one.unit ? " [" + one.unit + "]" : "");
  const [text, range, field, reset] = ["span", "input", "input", "button"].map((tag) => document.createElement(tag));
  const value = () => (one.name in tunedOf(name) ? tunedOf(name)[one.name] : one.value);
  text.textContent = label;
  Object.assign(range, { type: "range", min: 0, max: one.table.length ? one.table.length - 1 : WAYS });
  Object.assign(field, { type: "number", step: "any", placeholder: "own" });
  Object.assign(reset, { textContent: "↺", title: "as given" });
  for (const part of [range, field, reset]) part.setAttribute("aria-label", label + (part === reset ? " as given" : ""));
  const show = () => {
    const x = value();
    range.value = x === null ? Number(range.max) / 2 : placeOn(one, x);
    field.value = x === null ? "" : short(one.scale * x);
    reset.disabled = !(one.name in tunedOf(name));
  };
  const tune = (x) => {
    // the ghost has the same robot and ground
    const walks = one.shared ? known.filter((who) => who === name || numbers.walks[who].sliders.some((other) => other.name === one.name)) : [name];
    act({ do: "tune", slider: one.name, value: x, walks });
    show();
  };
  range.oninput = () => tune(valueOn(one, range.valueAsNumber));
  reset.onclick = () => tune(undefined);
  field.onchange = () => {
    const x = field.valueAsNumber / one.scale, inside = x >= one.low && x <= one.high, { table } = one;
    if (inside) tune(table.length ? table.reduce((a, b) => (Math.abs(b - x) < Math.abs(a - x) ? b : a)) : x);
    else complain(label + " is " + (field.value || "no number") + ", expected " + short(one.scale * one.low) + " to " + short(one.scale * one.high));
    show();
  };
  row.append(text, range, field, reset);
  show();
  return row;
}
