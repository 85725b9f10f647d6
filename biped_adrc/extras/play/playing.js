// The walk, its ghost, their clock and the hand: messages in, frames out.
const ROWS = 3, LONGEST = 0.3, BUSY = 50; // rows of a frame; [s] made good at once; [ms] of computing at once
const RANGE = [0.01, 10]; // rates
const EVERY = 10, KEPT = 6000; // samples between two instants of the timeline, and instants on it
const refusal = (words) => { throw new Error(words); };

class Play {
  constructor(name, ghost) {
    this.begin(name, ghost);
    Object.assign(this, { paused: false, rate: 1, reached: 1, owed: 0, last: performance.now() });
  }
  begin(name, ghost) {
    this.walking = [name, ghost].filter((x) => x !== null && x !== undefined).map((x) => Walk.begun(x));
    Object.assign(this, { samples: 0, hand: null, ends: Infinity, spring: null, past: [], place: null, log: [], drawn: [], news: true });
    this.rows = this.walking.map(() => []);
    this.keep(true);
    showNames(this.walking.map((walk) => walk.name));
  }
  get leader() { return this.walking.find((walk) => walk.walks) || this.walking[0]; }
  get walks() { return this.walking.some((walk) => walk.walks); }
  keep(begins) {
    this.past.push({ samples: this.samples, walking: [...this.walking], begins });
    if (this.past.length > KEPT) this.past.shift();
  }

  sample() {
    if (!this.walks) return;
    if (this.place !== null) this.forget();
    this.act();
    const first = this.walking.indexOf(this.leader);
    this.move(first);
    const until = this.walking[first].t;
    this.walking.forEach((_, k) => {
      while (k !== first && this.walking[k].walks && this.walking[k].t < until) this.move(k);
    });
    this.samples += 1;
    this.news = true;
    const begins = this.walking[0].step !== this.past.at(-1).walking[0].step;
    if (begins || this.samples % EVERY === 0) this.keep(begins);
  }
  move(k) {
    const before = this.walking[k], after = before.sampled(this.hand);
    this.walking[k] = after;
    this.rows[k].push(...after.rows);
    // the links have changed their names: the spring stays at the same metal
    if (k === 0 && this.spring && after.step !== before.step) this.spring.link = numbers.twins[this.spring.link] || this.spring.link;
  }
  // the hand for the coming sample, kept in the log for a file
  act() {
    const [walk] = this.walking, last = this.log.at(-1);
    if (this.samples >= this.ends) Object.assign(this, { hand: null, ends: Infinity });
    if (this.spring) this.hand = walk.walks ? this.pulled().hand : null;
    const { hand, samples } = this, { step, t, s: { t_start } } = walk;
    const other = hand !== (last ? last.hand : null) || (hand && last.step !== step);
    if (other && walk.walks) this.log.push({ samples, step, s: t - t_start, hand });
  }
  pulled() {
    const [walk] = this.walking, { link, at: point, anchor } = this.spring, { stiffness, damping } = numbers.spring, most = scene.most.force;
    const { p, J } = placed(linkPoint(link, point), walk.q), place = p.map((y, k) => y + walk.foot[k]);
    const pull = place.map((y, k) => stiffness * (anchor[k] - y) - damping * dot(J[k], walk.v));
    const size = Math.hypot(...pull), force = size > most ? pull.map((y) => y * (most / size)) : pull;
    return { place, hand: { torque: new Array(numbers.n).fill(0), link, at: point, force } };
  }

  // -- messages ------------------------------------------------------------------------------------
  pause() { this.paused = true; }
  go() { Object.assign(this, { paused: false, last: performance.now() }); }
  step() { this.paused = true; this.sample(); }
  // to an instant of the timeline; what was after it is forgotten with the next sample
  scrub({ place }) {
    const { samples, walking } = this.past[place];
    Object.assign(this, { place, samples, walking: [...walking], rows: walking.map(() => []) });
    this.let_go();
  }
  forget() {
    this.past.splice(this.place + 1);
    this.log = this.log.filter(({ samples }) => samples < this.samples);
    this.place = null;
  }
  // to where the single support began, or the one before
  back() {
    const place = this.past.findLastIndex(({ samples, begins }) => begins && samples < this.samples);
    this.scrub({ place: Math.max(place, 0) });
  }
  // from the start, `walk` in place of the walk
  reset({ walk } = {}) {
    const [before, ghost] = this.walking;
    this.begin(walk || before.name, ghost ? ghost.name : null);
  }
  ghost({ walk }) { this.begin(this.walking[0].name, walk); }
  // a slider of a walk; another structure begins anew
  tune({ slider, value, walks }) {
    for (const name of walks) {
      const { [slider]: _, ...others } = tunedOf(name);
      tuned[name] = Object.freeze(value === undefined ? others : { ...others, [slider]: value });
    }
    if (this.walking.some((walk) => kindOf(walk.name) !== walk.kind) || this.samples === 0) this.reset();
  }
  go_at({ rate }) {
    this.reached *= rate / this.rate;
    this.rate = Math.min(Math.max(rate, RANGE[0]), RANGE[1]);
  }
  push({ torque = {}, force = [0, 0], link = numbers.trunk, at: point = [0, 0], seconds = 0.2 }) {
    const { most } = scene, torques = scene.robot.coordinates.map((name) => torque[name] || 0);
    const largest = Math.max(...torques.map(Math.abs)), size = Math.hypot(...force);
    if (!(seconds > 0)) refusal("the push lasts " + seconds + " s, expected a positive time");
    if (!(largest <= most.torque)) refusal("the torque of the hand is " + largest + " N m, expected at most " + most.torque);
    if (!(size <= most.force)) refusal("the force of the hand is " + size + " N, expected at most " + most.force);
    this.let_go();
    this.hand = { torque: torques, link: this.named(link), at: point, force };
    this.ends = this.samples + Math.max(1, Math.round(seconds / this.leader.kind.period));
  }
  // `link` is one of the drawn robot
  pull({ link, at: point, anchor }) {
    Object.assign(this, { spring: { link: this.named(link), at: point, anchor }, ends: Infinity });
  }
  named(link) { return this.walking[0].exchanged ? numbers.twins[link] || link : link; }
  let_go() { Object.assign(this, { spring: null, ends: Infinity, hand: null }); }

  // -- frames --------------------------------------------------------------------------------------
  advance(now) {
    const passed = (now - this.last) / 1000;
    this.last = now;
    if (this.paused || !this.walks || passed <= 0) { this.owed = 0; return; }
    this.owed += this.rate * Math.min(LONGEST, passed);
    const begin = this.leader.t;
    while (this.owed > 0 && this.walks && performance.now() - now < BUSY) {
      const before = this.leader.t;
      this.sample();
      this.owed -= Math.max(this.leader.t - before, 0) || this.leader.kind.period;
    }
    this.owed = Math.min(this.owed, 0);
    this.reached += Math.min(1, passed) * ((this.leader.t - begin) / passed - this.reached);
  }
  frame() {
    const walks = this.walking.map((walk, k) => ({ ...pose(this.upright(walk, k)), ...rowsOf(this.rows[k]), ending: walk.ending }));
    const { paused, rate: asked, reached, past, place } = this, { limits } = this.walking[0];
    this.rows = this.walking.map(() => []);
    this.news = false;
    const timeline = [place === null ? past.length - 1 : place, past.length - 1];
    return { t: this.leader.t, paused, rate: asked, reached, limits, walks, timeline, hand: this.acting() };
  }
  // a fall is drawn until a link would be in the ground: the model has no contact but that of the feet
  upright(walk, k) {
    if (!this.drawn[k] || this.drawn[k].t > walk.t || above(walk)) this.drawn[k] = walk;
    return this.drawn[k];
  }
  acting() {
    const [walk] = this.walking;
    if (!walk.walks) return null;
    if (this.spring) {
      const { place, hand: { force } } = this.pulled();
      return { at: place, force, anchor: this.spring.anchor };
    }
    if (!this.hand || !this.hand.force.some((x) => x !== 0)) return null;
    const { p } = placed(linkPoint(this.hand.link, this.hand.at), walk.q);
    return { at: p.map((y, k) => y + walk.foot[k]), force: this.hand.force, anchor: null };
  }
}
const DEEP = 0.04; // [m] below the ground where a link is in it
function above(walk) {
  const places = [...scene.robot.links.map((link) => placed(linkPoint(link, [0, 0]), walk.q).p), walk.points.slice(2)];
  return places.every(([x, z]) => z + x * Math.tan(walk.slope) > -DEEP);
}
// as scene.js takes it, of one robot
function pose(walk) {
  const { q, foot: [x, z], exchanged, step } = walk, turned = (y) => numbers.R.map((line) => dot(line, y));
  const drawn = exchanged ? turned(q) : Array.from(q);
  const [base_x, base_z] = placed(linkPoint(numbers.trunk, [0, 0]), q).p;
  const torque = walk.hand ? walk.hand.torque : new Array(numbers.n).fill(0);
  const across = exchanged ? torque.map((_, j) => numbers.R.reduce((sum, line, i) => sum + line[j] * torque[i], 0)) : torque;
  return {
    joints: numbers.joints.map((k) => (k >= 0 ? drawn[k] : [x + base_x, z + base_z][-1 - k])),
    loads: [...groundOf(walk), ...across].map(finite),
    points: walk.points.map((y, k) => y + walk.foot[k % 2]),
    contact: [x, z, 0, 0, 0],
    support: { number: step, stance: Number(exchanged), x, z, slope: walk.slope },
  };
}
// what the page plots, of at most ROWS samples, and the worst of all
function rowsOf(instants) {
  if (!instants.length) return { rows: [], worst: null };
  const count = Math.min(ROWS, instants.length);
  const rows = Array.from({ length: count }, (_, k) => instants[Math.round((k + 1) * instants.length / count) - 1]);
  const friction = instants.some((x) => x.friction === null) ? null : Math.max(...instants.map((x) => x.friction));
  const normal = Math.min(...instants.map((x) => x.normal)), torque = Math.max(...instants.map((x) => x.torque));
  return { rows, worst: { normal, friction, torque } };
}

// -- what the hand did, as a scenario file -----------------------------------------------------------
const FRICTION = "hardware.friction"; // a share of the record's on a slider, a flag and an error in a file
function scenarioText({ walking: [walk], log, samples }) {
  if (walk.mixed) refusal("a slider was moved while it walked, and a file has one value of each: reset, walk and save again");
  const { lines, firstStep, sliders } = numbers.walks[walk.name], values = { "run.impacts": walk.step - firstStep + 1 };
  for (const [name, x] of Object.entries(walk.tuned)) Object.assign(values, { [name]: x }, sliders.find((one) => one.name === name).also);
  const { [FRICTION]: share } = walk.tuned;
  if (share !== undefined) Object.assign(values, { [FRICTION]: share > 0, "errors.friction": share > 0 ? share - 1 : 0 });
  const now = { step: walk.step, s: walk.t - walk.s.t_start, hand: null };
  const kept = lines.filter((line) => !(line.slice(0, line.indexOf(" = ")) in values));
  const added = Object.entries(values).map(([name, x]) => name + " = " + JSON.stringify(x));
  return ["# biped-adrc simulate --scenario by_hand.toml", ...kept, ...added, ...pushesOf([...log.filter((x) => x.samples < samples), now]).map(pushText), ""].join("\n");
}
// rows of the log that one push of the file has: in one single support, on one point of a link
function pushesOf(log) {
  const found = [];
  for (const { step, s, hand } of log) {
    const last = found.at(-1), where = hand && JSON.stringify([hand.link, hand.at]);
    if (last && last.step === step && (where === null || where === last.where)) last.rows.push([s, hand]);
    else {
      if (last && last.step === step) last.rows.push([s, null]);
      if (hand) found.push({ step, where, hand, rows: [[s, hand]] });
    }
  }
  return found;
}
function pushText({ step, hand: { link, at: point }, rows }) {
  const of = (name, size) => rows.map(([, hand]) => (hand ? hand[name] : new Array(size).fill(0)));
  const force = of("force", 2), torque = of("torque", numbers.n), some = (table) => table.flat().some((x) => x !== 0);
  const lines = ["[[pushes]]", 'shape = "hand"', "step = " + step, "times = " + JSON.stringify(rows.map(([s]) => s))];
  if (some(torque)) lines.push("torques = " + JSON.stringify(torque));
  if (some(force)) lines.push("on = " + JSON.stringify(link), "point = " + JSON.stringify(point), "forces = " + JSON.stringify(force));
  return "\n" + lines.join("\n");
}
