// Plays walks at any time t, from the data of the page; scene.js draws them.
const robots = scene.walks.map((walk) => new Robot(walk));
const leader = robots[0];

// -- time ------------------------------------------------------------------------------------------
const animator = viewer.animator;
const reduced = matchMedia("(prefers-reduced-motion: reduce)").matches;
const REST = 2; // [s] of standing still at the end where a walk ended badly
let playing = !reduced, speed = 1, last = null, rested = 0;

function describe(t, pose) {
  const support = leader.walk.supports[pose.arc];
  const now = scene.marks.filter((m) => m[0] <= t && t < m[1]).map((m) => ", " + m[2]);
  if (now.length === 0 && pose.loads.slice(2).some((zeta) => zeta !== 0)) now.push(", pushed");
  for (const robot of robots.filter((r) => r.cut > 0)) {
    const whose = robots.length > 1 ? " of " + robot.walk.name : "";
    now.push(", ground reaction" + whose + " " + robot.cut.toPrecision(3) + " N (arrow cut)");
  }
  for (const robot of robots.filter((r) => r.slips)) {
    now.push(robots.length > 1 ? ", " + robot.walk.name + " slips" : ", slips");
  }
  element("clock").textContent = "t = " + t.toFixed(2) + " s, step " + support.number + now.join("");
  tell(robots.filter((robot) => over(robot, t)).map((r) => r.walk.name + " " + r.walk.ending));
}
// whether a walk has ended by t [s] without having done what it was asked for
const over = ({ walk }, t) => walk.ending !== "" && t >= walk.end - 1e-9;
function tell(words) {
  element("message").textContent = words.join(". ");
  element("message").hidden = words.length === 0;
}
function show(t, poses) {
  animator.time = t;
  robots.forEach((robot, k) => robot.show(poses[k]));
  describe(t, poses[0]);
  viewer.set_dirty();
}
animator.seek = (t) => {
  t = Math.min(Math.max(t, scene.start), scene.end);
  show(t, robots.map((robot) => robot.at(t)));
  element("seek").value = t;
  element("seek").setAttribute("aria-valuetext", element("clock").textContent);
};
animator.play = () => {
  playing = true;
  last = null;
  if (animator.time >= scene.end) animator.seek(scene.start);
  element("play").textContent = "pause";
};
animator.pause = () => {
  playing = false;
  element("play").textContent = "play";
};
animator.update = () => {
  if (!playing) return;
  const now = performance.now();
  const before = last === null ? now : last;
  const t = animator.time + speed * 1e-3 * (now - before);
  last = now;
  const rest = robots.some((robot) => over(robot, scene.end)) ? REST : 0;
  if (t <= scene.end) animator.seek(t);
  else if (rested < rest) {
    if (rested === 0) animator.seek(scene.end);
    rested += 1e-3 * (now - before);
  } else animator.seek(scene.start);
  if (animator.time < scene.end) rested = 0;
};
animator.duration = scene.end - scene.start;

// -- controls --------------------------------------------------------------------------------------
const toggle = () => (playing ? animator.pause() : animator.play());
element("play").onclick = toggle;
element("seek").oninput = (e) => { animator.pause(); animator.seek(Number(e.target.value)); };
element("speed").onchange = (e) => { speed = Number(e.target.value); };
element("view").onclick = () => look(view === "side" ? "perspective" : "side");
const keys = {
  " ": toggle,
  ArrowLeft: () => { animator.pause(); animator.seek(animator.time - 1 / scene.fps); },
  ArrowRight: () => { animator.pause(); animator.seek(animator.time + 1 / scene.fps); },
  Home: () => animator.seek(scene.start),
  End: () => { animator.pause(); animator.seek(scene.end); },
  v: () => element("view").click(),
};
document.addEventListener("keydown", (e) => {
  const own = ["BUTTON", "SELECT", "INPUT"].includes(e.target.tagName);
  if (e.ctrlKey || e.altKey || e.metaKey || !(e.key in keys) || (own && e.key !== "v")) return;
  e.preventDefault();
  keys[e.key]();
});
viewer.gui.close();
look(scene.view);
animator.seek(scene.start);
if (playing) animator.play(); else animator.pause();
