// Four plots of the last seconds, each on a canvas of its own.
const KEPT_SECONDS = 60, SPANS = [0.2, 0.5, 1, 2, 4, 8, 16, 30]; // [s] kept and shown, by the wheel
let span = 4, hovered = null; // [s]; where the pointer is, as a share of the width
// slower than half of its pace fewer, so that time is drawn larger
const shown = () => span * Math.min(1, 2 * rate);
const STYLES = { // colour, width [px] and dashes of lines
  walk: ["#0072b2", 2, []], other: ["#d55e00", 2, [5, 3]], ghost: ["#666666", 1.5, [2, 3]], limit: ["#000", 1, [6, 4]], zero: ["#bbb", 1, []],
};
const past = { walk: [], ghost: [] }; // rows of signals of either, in order of time
let joint = 0;

const of = (name) => (signals) => signals[name][joint];
const PLOTS = [
  {
    canvas: "plot-error", unit: " mrad", scale: 1e3, least: 1, most: () => 500,
    lines: [["walk", of("error"), "walk"], ["ghost", of("error"), "ghost"]],
  },
  {
    canvas: "plot-xi", unit: " rad/s²", scale: 1, least: 10, most: () => 5000,
    lines: [["walk", of("xi"), "walk"], ["walk", of("xi_estimate"), "other"]],
  },
  {
    canvas: "plot-torque", unit: " N m", scale: 1, least: 20,
    most: () => 5 * scene.limits.torque, limits: () => [-scene.limits.torque, scene.limits.torque],
    lines: [["walk", of("u"), "walk"], ["ghost", of("u"), "ghost"]],
  },
  {
    canvas: "plot-ground", unit: "", scale: 1, least: 0.1, most: () => 2, limits: () => [scene.limits.friction],
    lines: [["walk", (s) => s.friction, "walk"], ["ghost", (s) => s.friction, "ghost"]],
  },
];

// what was after an instant that is gone back to goes with the first row that is new
function remember(message) {
  for (const [k, rows] of Object.values(past).entries()) {
    const added = message.walks[k] ? message.walks[k].rows : [];
    while (added.length && rows.length && rows.at(-1).t >= added[0].t) rows.pop();
    if (!message.walks[k]) rows.length = 0;
    rows.push(...added);
    while (rows.length && rows[0].t < message.t - KEPT_SECONDS) rows.shift();
  }
}

// values of one line up to the end [s]: pairs (t, y), y null where there is none
function valuesOf(plot, [whose, value], end) {
  const rows = past[whose], first = rows.findLastIndex(({ t }) => t < end - shown()) + 1, last = rows.findLastIndex(({ t }) => t <= end) + 1;
  return rows.slice(first, last).map((row) => [row.t, value(row)]).map(([t, y]) => [t, y === null ? null : plot.scale * y]);
}

// the least of 1, 2, 5 times a power of ten that is not below x
function ceiling(x) {
  const power = 10 ** Math.floor(Math.log10(x));
  return power * [1, 2, 5, 10].find((m) => m * power >= x * (1 - 1e-9));
}

function draw(plot, end) {
  const canvas = element(plot.canvas), ratio = devicePixelRatio || 1;
  const w = canvas.clientWidth, h = canvas.clientHeight;
  if (canvas.width !== Math.round(w * ratio)) canvas.width = Math.round(w * ratio);
  if (canvas.height !== Math.round(h * ratio)) canvas.height = Math.round(h * ratio);
  const pen = canvas.getContext("2d", { willReadFrequently: true });
  pen.setTransform(ratio, 0, 0, ratio, 0, 0);
  pen.clearRect(0, 0, w, h);
  const lines = plot.lines.map((line) => valuesOf(plot, line, end));
  const sizes = lines.flat().map(([, y]) => Math.abs(y || 0)).filter(Number.isFinite);
  const limits = plot.limits ? plot.limits() : [], least = Math.max(plot.least, limits.length ? limits.at(-1) : 0);
  const top = Math.min(ceiling(sizes.reduce((a, b) => Math.max(a, b), least)), plot.most());
  const low = plot.canvas === "plot-ground" ? 0 : -top;
  const at = (t, y) => [w * (1 - (end - t) / shown()), 4 + (h - 8) * (top - Math.max(-9 * top, Math.min(y, 9 * top))) / (top - low)];
  const across = (y, style) => stroke(pen, [[end - shown(), y], [end, y]], style, at);
  across(0, "zero");
  limits.filter((y) => y >= low && y <= top).forEach((y) => across(y, "limit"));
  lines.forEach((line, k) => stroke(pen, line, plot.lines[k][2], at));
  const scale = (low < 0 ? ", ±" : ", to ") + top + plot.unit;
  element(plot.canvas + "-scale").textContent = hovered === null ? scale : readings(lines, end - (1 - hovered) * shown()) + plot.unit;
  if (hovered !== null) pen.strokeRect(hovered * w, 0, 0, h);
}
// values of the lines at t [s], under the pointer
function readings(lines, t) {
  const found = lines.map((line) => line.find(([s, y]) => s >= t && y !== null)).filter(Boolean);
  return " at " + t.toFixed(3) + " s: " + found.map(([, y]) => Number(y.toPrecision(3))).join(", ");
}

function stroke(pen, line, style, at) {
  const [colour, width, dashes] = STYLES[style];
  Object.assign(pen, { strokeStyle: colour, lineWidth: width });
  pen.setLineDash(dashes);
  pen.beginPath();
  line.forEach(([t, y], k) => y !== null && (k > 0 && line[k - 1][1] !== null ? pen.lineTo(...at(t, y)) : pen.moveTo(...at(t, y))));
  pen.stroke();
}
function drawPlots(end) {
  element("shown").textContent = ", last " + Number(shown().toPrecision(2)) + " s";
  PLOTS.forEach((plot) => draw(plot, end));
}
element("plots").addEventListener("pointermove", (event) => {
  const box = event.target.getBoundingClientRect();
  hovered = event.target.tagName === "CANVAS" ? (event.clientX - box.left) / box.width : null;
  drawBeside();
});
element("plots").addEventListener("pointerleave", () => { hovered = null; drawBeside(); });
element("plots").addEventListener("wheel", (event) => {
  if (event.target.tagName !== "CANVAS") return;
  event.preventDefault();
  const k = SPANS.indexOf(span) + Math.sign(event.deltaY);
  span = SPANS[Math.min(Math.max(k, 0), SPANS.length - 1)];
  drawBeside();
}, { passive: false });
