// The walk, its ghost, their clock and the hand: messages in, frames out.
const ROWS = 3, LONGEST = 0.1, BUSY = 50; // rows of a frame; [s] made good at once; [ms] of computing at once
const RANGE = [0.01, 10]; // rates
const refusal = (words) => { throw new Error(words); };

class Play {
  constructor(name, ghost) {
    this.begin(name, ghost);
    Object.assign(this, { paused: false, rate: 1, reached: 1, owed: 0, last: performance.now() });
  }
  begin(name, ghost) {
    this.walking = [name, ghost].filter((x) => x !== null && x !== undefined).map((x) => Walk.begun(x));
    Object.assign(this, { samples: 0, hand: null, ends: Infinity, spring: null, marks: [] });
    this.made = this.walking.map(() => []);
    this.mark();
    showNames(this.walking.map((walk) => walk.name));
  }
  get leader() { return this.walking.find((walk) => walk.walks) || this.walking[0]; }
  get walks() { return this.walking.some((walk) => walk.walks); }
  mark() { this.marks.push({ samples: this.samples, walking: [...this.walking] }); }

  sample() {
    if (!this.walks) return;
    this.act();
    const first = this.walking.indexOf(this.leader);
    this.move(first);
    const until = this.walking[first].t;
    this.walking.forEach((_, k) => {
      while (k !== first && this.walking[k].walks && this.walking[k].t < until) this.move(k);
    });
    this.samples += 1;
  }
  move(k) {
    const before = this.walking[k], after = before.sampled(this.hand);
    this.walking[k] = after;
    this.made[k].push(...after.rows);
    // the links have changed their names: the spring stays at the same metal
    if (k === 0 && this.spring && after.step !== before.step) this.spring.link = numbers.twins[this.spring.link] || this.spring.link;
  }
  // the hand for the coming sample
  act() {
    if (this.walking[0].step !== this.marks[this.marks.length - 1].walking[0].step) this.mark();
    if (this.samples >= this.ends) Object.assign(this, { hand: null, ends: Infinity });
    if (this.spring) this.hand = this.walking[0].walks ? this.pulled().hand : null;
  }
  pulled() {
    const walk = this.walking[0], { link, at: point, anchor } = this.spring, { stiffness, damping } = numbers.spring, most = scene.most.force;
    const { p, J } = placed(linkPoint(link, point), walk.q), [x, z] = p.map((y, k) => y + walk.foot[k]);
    const pull = [x, z].map((y, k) => stiffness * (anchor[k] - y) - damping * dot(J[k], walk.v));
    const size = Math.hypot(...pull), force = size > most ? pull.map((y) => y * (most / size)) : pull;
    return { place: [x, z], hand: { torque: new Array(numbers.n).fill(0), link, at: point, force } };
  }

  // -- messages ------------------------------------------------------------------------------------
  pause() { this.paused = true; }
  go() { Object.assign(this, { paused: false, last: performance.now() }); }
  step() { this.paused = true; this.sample(); }
  back() {
    const [earlier] = this.marks.filter(({ samples }) => samples < this.samples).slice(-1), mark = earlier || this.marks[0];
    this.marks.splice(this.marks.indexOf(mark) + 1);
    Object.assign(this, { samples: mark.samples, walking: [...mark.walking], made: mark.walking.map(() => []) });
    this.let_go();
  }
  // from the start, `walk` in place of the walk
  reset({ walk }) {
    const [before, ghost] = this.walking;
    this.begin(walk || before.name, ghost ? ghost.name : null);
  }
  ghost({ walk }) { this.begin(this.walking[0].name, walk); }
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
    const acting = this.acting();
    const walks = this.walking.map((walk, k) => ({ ...pose(walk), ...told(this.made[k]), ending: walk.ending }));
    const { paused, rate: asked, reached } = this, { limits } = this.walking[0].kind;
    this.made = this.walking.map(() => []);
    return { t: this.leader.t, paused, rate: asked, reached, limits, walks, hand: acting };
  }
  acting() {
    const walk = this.walking[0];
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
    support: { number: step, stance: Number(exchanged), x, z, slope: walk.kind.slope },
  };
}
// what the page plots, of at most ROWS samples, and the worst of all
function told(made) {
  if (!made.length) return { rows: [], worst: null };
  const count = Math.min(ROWS, made.length);
  const rows = Array.from({ length: count }, (_, k) => made[Math.round((k + 1) * made.length / count) - 1]);
  const friction = made.some((x) => x.friction === null) ? null : Math.max(...made.map((x) => x.friction));
  const normal = Math.min(...made.map((x) => x.normal)), torque = Math.max(...made.map((x) => x.torque));
  return { rows, worst: { normal, friction, torque } };
}
