// A walk moved on by WebAssembly: one sample after the other, and what is seen at its end.
const { numbers } = scene, at = numbers.places;
const unpacked = (text) => bytes(text).buffer;
const STACK = 1 << 18; // [bytes] of constants and stack, before the vectors of the walks
const SEEN = Math.max(...Object.values(numbers.signals).map(([, end]) => end)); // numbers of all signals

// the next number after x towards y, as in C
function nextafter(x, y) {
  if (Number.isNaN(x) || Number.isNaN(y) || x === y) return x + y - x;
  if (x === 0) return y > 0 ? 5e-324 : -5e-324;
  const number = new Float64Array([x]), bits = new BigInt64Array(number.buffer);
  bits[0] += (x < y) === (x > 0) ? 1n : -1n;
  return number[0];
}
const machine = { memory: null, calls: null, free: STACK };
async function startMachine() {
  const module = await WebAssembly.compile(unpacked(numbers.code));
  const all = Object.values(numbers.walks).flatMap(({ variants }) => variants);
  const size = all.reduce((sum, { cells }) => sum + cells.length + 8 * SEEN, STACK);
  machine.memory = new WebAssembly.Memory({ initial: Math.ceil(size / 65536) });
  const table = new WebAssembly.Table({ initial: numbers.functions.length + 1, element: "anyfunc" });
  const env = {
    __linear_memory: machine.memory, __indirect_function_table: table,
    __stack_pointer: new WebAssembly.Global({ value: "i32", mutable: true }, STACK),
    nextafter, exp2: (x) => 2 ** x,
  };
  for (const { name } of WebAssembly.Module.imports(module)) if (!(name in env)) env[name] = Math[name];
  await WebAssembly.instantiate(module, { env });
  machine.calls = Object.fromEntries(numbers.functions.map((name, k) => [name, table.get(k + 1)]));
  for (const [name, walk] of Object.entries(numbers.walks)) kinds[name] = walk.variants.map((one) => new Kind(one));
}
// a vector in the module's memory
function vector(Cells, values) {
  const found = new Cells(machine.memory.buffer, machine.free, typeof values === "number" ? values : values.length);
  if (typeof values !== "number") found.set(values);
  machine.free += 8 * found.length;
  return found;
}
const dot = (a, b) => a.reduce((sum, x, k) => sum + x * b[k], 0);

// the closed form of a point (x, z) [m] of a link
function linkPoint(link, [x, z]) {
  const { re, im, turn } = numbers.links.of[link];
  const there = ([zero, alongX, alongZ]) => zero.map((d, k) => d + x * alongX[k] + z * alongZ[k]);
  return { re: there(re), im: there(im), turn };
}
// its place from the stance foot [m], and the rows of its Jacobian
function placed({ re, im }, q) {
  const a = numbers.links.A.map((row) => dot(row, q)), c = a.map(Math.cos), s = a.map(Math.sin);
  const columns = (d) => numbers.links.A[0].map((_, j) => numbers.links.A.reduce((sum, row, i) => sum + row[j] * d[i], 0));
  return {
    p: [dot(re, c) - dot(im, s), dot(im, c) + dot(re, s)],
    J: [columns(re.map((d, k) => -d * s[k] - im[k] * c[k])), columns(re.map((d, k) => d * c[k] - im[k] * s[k]))],
  };
}

// the block of one structure of a walk in the module's memory, used by one walk at a time: `Walk` keeps what changes
class Kind {
  constructor(message) {
    Object.assign(this, message, { tuned: null });
    this.cells = vector(BigInt64Array, new BigInt64Array(unpacked(message.cells)));
    this.address = this.cells.byteOffset;
    message.pointers.forEach((k) => { this.cells[k] += BigInt(this.address); });
    this.numbers = new Float64Array(this.cells.buffer, this.address, this.cells.length);
    this.defaults = this.numbers.slice();
    this.values = this.row("values", 3);
    this.x = this.row("x0", this.nx);
    this.seen = vector(Float64Array, SEEN);
    this.first = this.state();
  }
  row(name, size) {
    const first = (Number(this.cells[at[name]]) - this.address) / 8;
    return this.numbers.subarray(first, first + size);
  }
  state() {
    const [t, step, t_start, t_arc] = [at.t, at.step, at.t_start, at.t_arc].map((k) => this.numbers[k]);
    return { t, step, t_start, t_arc, head: this.cells.slice(at.t, at.nodes), values: this.values.slice(), x: this.x.slice() };
  }
  set({ head, values, x }) {
    this.cells.set(head, at.t);
    this.values.set(values);
    this.x.set(x);
  }
  // the numbers that go with the values of the sliders: of a table, or a + b s^power, or a + b tan s for 0
  tune(tuned) {
    if (tuned === this.tuned) return;
    this.tuned = tuned;
    for (const [name, [table, cells]] of Object.entries(this.sliders)) {
      const s = tuned[name], k = table.indexOf(s);
      for (const [cell, form] of cells) {
        const [a, b, power] = form;
        if (s === undefined) this.numbers[cell] = this.defaults[cell];
        else this.numbers[cell] = table.length ? form[k] : a + b * (power ? s ** power : Math.tan(s));
      }
    }
  }
  hold(hand) {
    const { torque, force, re, im, turn } = this.hand;
    torque.forEach((k, i) => { this.numbers[k] = hand ? hand.torque[i] : 0; });
    force.forEach((k, i) => { this.numbers[k] = hand ? hand.force[i] : 0; });
    if (!hand) return;
    const point = linkPoint(hand.link, hand.at);
    [[re, point.re], [im, point.im], [turn, point.turn]].forEach(([k, x]) => this.numbers.set(x, k));
  }
}
const kinds = {};
const NOTHING = Object.freeze({}), tuned = {}; // values of sliders by name of a walk, another object for each change
const tunedOf = (name) => tuned[name] || NOTHING;
// the structure of a walk for its delay: one for each whole number of samples, and those of a whole delay
function kindOf(name) {
  const delay = tunedOf(name)["hardware.delay"];
  const fits = ({ delays: [low, high] }) => (low === high ? delay === low : low < delay && delay < high);
  return kinds[name].find((kind) => (delay === undefined ? kind.asGiven : fits(kind)));
}

// where a walk is; another one of each is made, so that an earlier one can be gone back to
class Walk {
  constructor(before, s) {
    Object.assign(this, before, { s, status: 0, rows: [] });
  }
  static begun(name) {
    const kind = kindOf(name), walk = new Walk({ name, kind, foot: [0, 0], tuned: tunedOf(name), mixed: false, hand: null }, kind.first);
    kind.tune(walk.tuned);
    walk.look();
    return walk;
  }
  get t() { return this.s.t; }
  get step() { return this.s.step; }
  get x() { return this.s.x; }
  get q() { return this.x.subarray(0, numbers.n); }
  get v() { return this.x.subarray(numbers.n, 2 * numbers.n); }
  get walks() { return this.status === 0; }
  get ending() {
    const [word, reason] = numbers.status[this.status];
    return this.walks ? "" : word + " at " + this.t.toFixed(2) + " s: " + reason;
  }
  get exchanged() { return numbers.exchanged[(this.step + 1) % 2]; }
  get slope() { return this.tuned["ground.slope"] ?? this.kind.slope; }
  get limits() { return { ...this.kind.limits, torque: this.tuned["hardware.torque_limit"] || this.kind.limits.torque }; }

  // the first sample instant after now [s], by the expression that the engines have
  until() {
    const start = this.kind.restart ? this.s.t_arc : 0, { period } = this.kind;
    let k = Math.max(0, Math.floor((this.t - start) / period));
    while (start + k * period <= this.t) k += 1;
    return start + k * period;
  }
  // one sample on under a hand, or to the impact within it, with what is seen at its end
  sampled(hand) {
    const { kind } = this, { go_on, land } = machine.calls, values = tunedOf(this.name);
    kind.tune(values);
    kind.hold(hand);
    kind.set(this.s);
    kind.numbers[at.t_end] = this.until();
    kind.cells[at.every] = 0n;
    let code = Number(go_on(kind.address));
    const after = new Walk(this, kind.state());
    Object.assign(after, { hand, tuned: values, mixed: this.mixed || values !== this.tuned });
    after.look();
    after.rows = [row(after)];
    if (code === numbers.struck) {
      code = Number(land(kind.address));
      if (code === 0) after.landed(kind.state());
    }
    after.status = code;
    return after;
  }
  look() {
    this.kind.set(this.s);
    machine.calls.look(this.kind.address, BigInt(this.kind.observe), this.kind.seen.byteOffset);
    this.seen = this.kind.seen.slice();
    this.points = [...signal(this, "hip"), ...signal(this, "swing_foot")];
  }
  // in x+ on the other foot; the hip stays where it is
  landed(s) {
    const [hip_x, hip_z, dx, dz] = this.points, [foot_x, foot_z] = this.foot;
    this.s = s;
    this.foot = [foot_x + dx, foot_z + dz];
    this.points = [hip_x - dx, hip_z - dz, -dx, -dz];
  }
}
const signal = (walk, name) => Array.from(walk.seen.subarray(...numbers.signals[name]));
const finite = (x) => (Number.isFinite(x) ? x : null);

// the ground's force on the foot (F_x, F_z) [N], without what the hand carries; along and out of the slope
function groundOf(walk) {
  const force = signal(walk, "ground_reaction"), hand = walk.hand ? walk.hand.force : [0, 0];
  return [force[0] - hand[0], force[1] - hand[1]];
}
function pressing(walk) {
  const [x, z] = groundOf(walk), c = Math.cos(walk.slope), s = Math.sin(walk.slope);
  return [x * c - z * s, x * s + z * c];
}
function row(walk) {
  const [along, out] = pressing(walk), q_d = signal(walk, "q_d"), u = signal(walk, "u");
  return {
    t: walk.t, error: q_d.map((x, k) => finite(walk.q[k] - x)), xi: signal(walk, "xi").map(finite),
    xi_estimate: signal(walk, "xi_estimate").map(finite), u: u.map(finite),
    friction: out > 0 ? Math.abs(along) / out : null, normal: out, torque: Math.max(...u.map(Math.abs)),
  };
}
