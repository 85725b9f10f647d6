// What a session, its clock and its server do, on a page without them: messages in, frames out.
const ROWS = 3, LONGEST = 0.1, BUSY = 50; // rows of a frame; [s] made good at once; [ms] of computing at once
const RANGE = [0.01, 10]; // rates
const refusal = (words) => { throw new Error(words); };

class OfflineSession {
  constructor(name, ghost) {
    this.begin(name, ghost);
    Object.assign(this, { paused: false, rate: 1, reached: 1, owed: 0, last: performance.now() });
  }
  begin(name, ghost) {
    this.walking = [name, ghost].filter((x) => x !== null && x !== undefined).map((x) => OfflineWalk.begun(x));
    Object.assign(this, { samples: 0, hand: null, ends: Infinity, spring: null, marks: [] });
    this.made = this.walking.map(() => []);
    this.mark();
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
    if (k === 0 && this.spring && after.step !== before.step) this.spring.link = off.twins[this.spring.link] || this.spring.link;
  }
  // the hand for the coming sample
  act() {
    if (this.walking[0].step !== this.marks[this.marks.length - 1].walking[0].step) this.mark();
    if (this.samples >= this.ends) Object.assign(this, { hand: null, ends: Infinity });
    if (this.spring) this.hand = this.walking[0].walks ? this.pulled().hand : null;
  }
  pulled() {
    const walk = this.walking[0], { link, at: point, anchor } = this.spring, { stiffness, damping, most } = off.spring;
    const { p, J } = placed(linkPoint(link, point), walk.q), [x, z] = p.map((y, k) => y + walk.foot[k]);
    const pull = [x, z].map((y, k) => stiffness * (anchor[k] - y) - damping * dot(J[k], walk.v));
    const size = Math.hypot(...pull), force = size > most ? pull.map((y) => y * (most / size)) : pull;
    return { place: [x, z], hand: { torque: new Array(off.n).fill(0), link, at: point, force } };
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
  reset({ values = {} }) {
    const [walk, ghost] = this.walking;
    this.begin(known_walk(values.walk || walk.name), ghost ? ghost.name : null);
  }
  change(given) { this.reset(given); }
  set_rate({ rate }) {
    this.reached *= rate / this.rate;
    this.rate = Math.min(Math.max(rate, RANGE[0]), RANGE[1]);
  }
  push({ torque = {}, force = [0, 0], link = off.trunk, at: point = [0, 0], seconds = 0.2 }) {
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
  named(link) { return this.walking[0].exchanged ? off.twins[link] || link : link; }
  let_go() { Object.assign(this, { spring: null, ends: Infinity, hand: null }); }
  ghost({ values }) { this.begin(this.walking[0].name, values ? known_walk(values.controller) : null); }
  save() { return { remark: "this page keeps nothing; 'biped-adrc play' saves what was done, to be walked again" }; }

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
    return { t: this.leader.t, paused, rate: asked, reached, limits, walks, hand: acting, felt: this.hand !== null };
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
const known_walk = (name) => (name in kinds ? name : refusal("'" + name + "' does not walk on this page"));

// as scene.js takes it, of one robot
function pose(walk) {
  const { q, foot: [x, z], exchanged, step } = walk, turned = (y) => off.R.map((line) => dot(line, y));
  const drawn = exchanged ? turned(q) : Array.from(q);
  const [base_x, base_z] = placed(linkPoint(off.trunk, [0, 0]), q).p;
  const torque = walk.hand ? walk.hand.torque : new Array(off.n).fill(0);
  const across = exchanged ? torque.map((_, j) => off.R.reduce((sum, line, i) => sum + line[j] * torque[i], 0)) : torque;
  return {
    joints: off.joints.map((k) => (k >= 0 ? drawn[k] : [x + base_x, z + base_z][-1 - k])),
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
  const worst = {
    normal: Math.min(...made.map((x) => x.normal)), friction, torque: Math.max(...made.map((x) => x.torque)), slips: null,
  };
  return { rows, worst };
}

// in place of the socket to a server
class OfflineSocket {
  constructor() {
    this.readyState = WebSocket.CONNECTING;
    startMachine().then(() => {
      Object.keys(off.walks).forEach((name) => { kinds[name] = new Kind(name); });
      this.session = new OfflineSession(off.first, off.ghost);
      this.readyState = WebSocket.OPEN;
      this.say(this.values());
      this.turn(performance.now());
    }).catch((error) => tell("This page cannot walk here: " + error.message));
  }
  say(message) { this.onmessage({ data: JSON.stringify(message) }); }
  values() {
    return { values: this.session.walking.map(({ name }) => ({ walk: name, controller: name })) };
  }
  send(text) {
    const { do: word, ...given } = JSON.parse(text);
    try {
      const answer = this.session[word === "rate" ? "set_rate" : word](given);
      if (answer) this.say(answer);
      if (["change", "ghost", "reset", "back"].includes(word)) this.say(this.values());
    } catch (error) {
      this.say({ refused: error.message, names: Object.keys(given.values || {}) });
    }
  }
  turn(now) {
    this.session.advance(now);
    this.say(this.session.frame());
    requestAnimationFrame((next) => this.turn(next));
  }
}
