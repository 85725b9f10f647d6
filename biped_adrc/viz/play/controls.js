// Sliders, choices and buttons: each sends a message, and shows what the session has.
let known = [{}, {}]; // values of the walk and of its ghost
const STEPS = 1000; // of a slider

const positionOf = (c, x) => Math.round(STEPS * (c.factor
  ? Math.log(x / c.low) / Math.log(c.high / c.low)
  : (x - c.low) / (c.high - c.low)));
const valueAt = (c, k) => Number((c.factor
  ? c.low * (c.high / c.low) ** (k / STEPS)
  : c.low + (c.high - c.low) * k / STEPS).toPrecision(3));
const usual = (c) => (c.usual === undefined ? c.given : c.usual);
const act = (message) => { forgive(); send(message); };
const change = (values) => act({ do: "change", values });

const has = (values) => Object.entries(values).every(([name, x]) => known[0][name] === x);
function showSlider(c) {
  const x = known[0][c.name], range = element("range-" + c.name), field = element("field-" + c.name);
  if (document.activeElement !== field) field.value = x === null ? "" : x;
  range.value = positionOf(c, x === null ? usual(c) : x);
  range.disabled = field.disabled = !has(c.needs || {});
  range.setAttribute("aria-valuetext", x === null ? c.words : x + " " + c.unit);
}
function wireSlider(c) {
  const range = element("range-" + c.name), field = element("field-" + c.name);
  const sent = (x, along = {}) => change({ [c.name]: x, ...along });
  element("mark-" + c.name).style.setProperty("--share", positionOf(c, usual(c)) / STEPS);
  range.oninput = () => { field.value = valueAt(c, range.value); };
  range.onchange = () => sent(valueAt(c, range.value));
  field.onchange = () => {
    const x = field.value.trim();
    if (x !== "" && !Number.isFinite(Number(x))) { complain(c.name, "'" + x + "' is no number"); showSlider(c); }
    else if (x === "") sent(c.given, c.emptied);
    else sent(Number(x));
  };
  field.onblur = () => showSlider(c);
}

// the option whose values are those of the walk; a value of a scenario file may be none of them
function showChoice(c) {
  const named = ({ values }) => values[c.name] === known[0][c.name];
  const choice = element("choice-" + c.name);
  let k = c.options.findIndex(({ values }) => has(values));
  if (k < 0) k = c.options.findIndex(named);
  choice.options[c.options.length].hidden = k >= 0;
  choice.options[c.options.length].textContent = String(known[0][c.name]);
  choice.selectedIndex = k < 0 ? c.options.length : k;
}
function wireChoice(c) {
  element("choice-" + c.name).onchange = (event) => {
    const option = c.options[event.target.selectedIndex];
    if (!option) return;
    const along = Object.entries(option.values[c.name] === null ? {} : c.along || {});
    change({ ...option.values, ...Object.fromEntries(along.filter(([name]) => known[0][name] === null)) });
  };
}

const OF_GHOST = ["walk", "controller", "observer", "order", "bandwidth"]; // these are told by its name, or usual
function showValues(values) {
  known = values;
  scene.controls.sliders.forEach(showSlider);
  scene.controls.choices.forEach(showChoice);
  element("ghost").value = values.length > 1 ? values[1].controller : "";
  const other = ([name, x]) => !OF_GHOST.includes(name) && x !== values[0][name];
  const differ = values.length > 1 ? Object.entries(values[1]).filter(other) : [];
  element("ghost-values").textContent = differ.map(([name, x]) => name + " " + (x === null ? "none" : x)).join(", ");
}

// what was refused is forgotten with the next thing that is done
const REFUSALS = [...document.querySelectorAll(".refused")];
const forgive = () => REFUSALS.forEach((place) => { place.textContent = ""; });
// a sentence at the field that it is of, or above all; the field goes back to what the session has
function complain(name, sentence) {
  const place = element("refused-" + name) || element("refused");
  place.textContent = sentence;
}
function refuse({ refused, names }) {
  const name = names.find((x) => element("refused-" + x));
  complain(name || "", refused);
  if (document.activeElement) document.activeElement.blur();
  showValues(known);
}

const RATES = [0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10];
let rate = 1, paused = false;
function faster(by) {
  const k = RATES.findIndex((x) => x >= rate * (1 - 1e-9)) + by;
  rate = RATES[Math.min(Math.max(k, 0), RATES.length - 1)]; // for a second press before the next frame
  send({ do: "rate", rate });
}
// numbers of the hand; what is none is said, and nothing is sent
function handed(names, message) {
  const found = names.map((name) => element(name).valueAsNumber);
  forgive();
  const wrong = names.filter((_, k) => !Number.isFinite(found[k]));
  if (wrong.length) complain("", "the hand's " + wrong.join(" and ") + " is no number");
  else send({ do: "push", ...message(...found) });
}
function pushJoint(sign) {
  handed(["torque", "seconds"], (torque, seconds) => ({ torque: { [element("joint").value]: sign * torque }, seconds }));
}
function shove(sign) {
  const link = element("link").value, at = selected && selected.link === link ? selected.at : [0, 0];
  handed(["shove", "seconds"], (force, seconds) => ({ link, at, force: [sign * force, 0], seconds }));
}
function ghostOf(controller) {
  act(controller === "" ? { do: "ghost" } : { do: "ghost", values: { controller } });
}
const toggle = () => send({ do: paused ? "go" : "pause" });
const ACTIONS = {
  play: toggle,
  step: () => send({ do: "step" }),
  back: () => act({ do: "back" }),
  reset: () => act({ do: "reset" }),
  slower: () => faster(-1),
  faster: () => faster(1),
  save: () => act({ do: "save" }),
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
scene.controls.sliders.forEach(wireSlider);
scene.controls.choices.forEach(wireChoice);
element("ghost").onchange = (event) => ghostOf(event.target.value);
element("plotted").onchange = (event) => { joint = event.target.selectedIndex; drawPlots(); };
element("close-keys").onclick = () => element("keys").close();
