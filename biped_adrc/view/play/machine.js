// A walk moved on by WebAssembly: one sample after the other, and what is seen at its end.
const { numbers } = scene, at = numbers.places;
const unpacked = (text) => Uint8Array.from(atob(text), (c) => c.charCodeAt(0)).buffer;
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
const machine = { memory: null, calls: null, free: STACK, table: null };
async function startMachine() {
  const module = await WebAssembly.compile(unpacked(numbers.code));
  const room = ({ cells }) => cells.length + 8 * SEEN;
  const size = Object.values(numbers.walks).reduce((sum, told) => sum + room(told), STACK);
  machine.memory = new WebAssembly.Memory({ initial: Math.ceil(size / 65536) });
  machine.table = new WebAssembly.Table({ initial: numbers.functions.length + 1, element: "anyfunc" });
  const env = {
    __linear_memory: machine.memory, __indirect_function_table: machine.table,
    __stack_pointer: new WebAssembly.Global({ value: "i32", mutable: true }, STACK),
    nextafter, exp2: (x) => 2 ** x,
  };
  for (const { name } of WebAssembly.Module.imports(module)) if (!(name in env)) env[name] = Math[name];
  machine.calls = (await WebAssembly.instantiate(module, { env })).exports;
  numbers.functions.forEach((name, k) => machine.table.set(k + 1, machine.calls[name]));
}
// a vector in the module's memory
function vector(Kind, given) {
  const found = new Kind(machine.memory.buffer, machine.free, typeof given === "number" ? given : given.length);
  if (typeof given !== "number") found.set(given);
  machine.free += 8 * found.length;
  return found;
}
const dot = (a, b) => a.reduce((sum, x, k) => sum + x * b[k], 0);

// the closed form of a point (x, z) [m] of a link
function linkPoint(link, [x, z]) {
  const { re, im, turn } = numbers.links.of[link];
  const at = ([zero, alongX, alongZ]) => zero.map((d, k) => d + x * alongX[k] + z * alongZ[k]);
  return { re: at(re), im: at(im), turn };
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

// the block of each kind of walk in the module's memory, used by one walk at a time: `Walk` keeps what changes
class Kind {
  constructor(name) {
    const told = numbers.walks[name];
    Object.assign(this, told, { name });
    this.cells = vector(BigInt64Array, new BigInt64Array(unpacked(told.cells)));
    this.address = this.cells.byteOffset;
    told.pointers.forEach((k) => { this.cells[k] += BigInt(this.address); });
    this.numbers = new Float64Array(this.cells.buffer, this.address, this.cells.length);
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
    const [t, step, t_arc] = [at.t, at.step, at.t_arc].map((k) => this.numbers[k]);
    return { t, step, t_arc, head: this.cells.slice(at.t, at.nodes), values: this.values.slice(), x: this.x.slice() };
  }
  set({ head, values, x }) {
    this.cells.set(head, at.t);
    this.values.set(values);
    this.x.set(x);
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

// where a walk is; another one of each is made, so that an earlier one can be gone back to
class Walk {
  constructor(name, s, foot) {
    Object.assign(this, { name, s, foot, status: 0, rows: [] });
  }
  static begun(name) {
    const walk = new Walk(name, kinds[name].first, [0, 0]);
    walk.look(walk.kind);
    return walk;
  }
  get kind() { return kinds[this.name]; }
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

  // the first sample instant after now [s], by the expression that the engines have
  until() {
    const start = this.kind.restart ? this.s.t_arc : 0, { period } = this.kind;
    let k = Math.max(0, Math.floor((this.t - start) / period));
    while (start + k * period <= this.t) k += 1;
    return start + k * period;
  }
  // one sample on under a hand, or to the impact within it, with what is seen at its end
  sampled(hand) {
    const { kind } = this, { go_on, land } = machine.calls;
    kind.hold(hand);
    kind.set(this.s);
    kind.numbers[at.t_end] = this.until();
    kind.cells[at.every] = 0n;
    let code = Number(go_on(kind.address));
    const after = new Walk(this.name, kind.state(), this.foot);
    after.hand = hand;
    after.look(kind);
    after.rows = [row(after)];
    if (code === numbers.struck) {
      code = Number(land(kind.address));
      if (code === 0) after.landed(kind.state());
    }
    after.status = code;
    return after;
  }
  look(kind) {
    kind.set(this.s);
    machine.calls.look(kind.address, BigInt(kind.observe), kind.seen.byteOffset);
    this.seen = kind.seen.slice();
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
  const [x, z] = groundOf(walk), c = Math.cos(walk.kind.slope), s = Math.sin(walk.kind.slope);
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
