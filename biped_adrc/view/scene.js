"use strict";
// Robots in Meshcat's viewer: their parts, one pose of each at a time, and the cameras.
const scene = JSON.parse(document.getElementById("scene").textContent);
const element = (id) => document.getElementById(id);
// a page with a painter of its own says itself when it paints
const pane = element("meshcat-pane");
const viewer = typeof Painter === "undefined" ? new MeshCat.Viewer(pane) : new MeshCat.Viewer(pane, false, new Painter(pane));
const bytes = (text) => Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
const command = (text) => viewer.handle_command_bytearray(bytes(text));
const node = (path) => viewer.scene_tree.find(path.split("/")).object;

// the viewer keeps the left edge of an orthographic camera and moves the right one; keep the middle instead
const resize = viewer.set_3d_pane_size.bind(viewer);
viewer.set_3d_pane_size = (w, h) => {
  const camera = viewer.camera;
  const width = w === undefined ? viewer.dom_element.offsetWidth : w;
  const height = h === undefined ? viewer.dom_element.offsetHeight : h;
  if (camera.isOrthographicCamera) {
    camera.left = -0.5 * (camera.top - camera.bottom) * width / height;
  }
  resize(width, height);
};
scene.commands.forEach(command);

// -- one walk --------------------------------------------------------------------------------------
class Trace {
  constructor(path, broken) {
    this.line = node(path + "/<object>");
    this.line.frustumCulled = false; // its points move after its bounds were computed
    this.broken = broken;
  }
  // points: {x, z, arc}; a broken trace has no line from one arc to the next
  fill(points) {
    const place = this.line.geometry.attributes.position;
    const count = Math.min(points.length - 1, place.count / 2);
    for (let i = 0; i < count; i++) {
      const b = points[i + 1];
      const a = this.broken && points[i].arc !== b.arc ? b : points[i];
      place.array.set([a.x, 0, a.z, b.x, 0, b.z], 6 * i);
    }
    this.line.geometry.setDrawRange(0, 2 * Math.max(count, 0));
    place.needsUpdate = true;
  }
}

class Arrow {
  constructor(path, walk) {
    this.whole = node(path);
    this.shaft = node(path + "/shaft");
    this.head = node(path + "/head");
    this.walk = walk;
  }
  // a force [N] on the foot at x, z [m]; its size [N] where the arrow is cut, else 0
  show(x, z, tangent, normal) {
    const w = this.walk, size = Math.hypot(tangent, normal);
    const whole = w.metres_per_newton * size;
    const length = Math.min(w.longest, whole), tip = Math.min(w.head, length);
    this.whole.visible = length > 0 && Number.isFinite(whole); // a walk that diverges may overflow
    this.whole.position.set(x, 0, z + w.ground);
    const half = 0.5 * Math.atan2(tangent, normal);
    this.whole.quaternion.set(0, Math.sin(half), 0, Math.cos(half));
    this.shaft.scale.set(1, 1, Math.max(length - tip, 1e-6));
    this.head.position.set(0, 0, length - tip);
    this.head.scale.setScalar(Math.max(tip / w.head, 1e-6));
    return whole > w.longest ? size : 0;
  }
}

class Robot {
  constructor(walk) {
    this.walk = walk;
    this.joints = walk.joints.map((j) => ({ ...j, object: node(j.path) }));
    this.legs = walk.legs.map((leg) => leg.map((path) => node(path + "/<object>").material));
    this.rings = walk.rings.map(node);
    this.arrows = walk.arrows.map((path) => new Arrow(path, walk));
    this.hip = new Trace(walk.traces[0], false);
    this.foot = new Trace(walk.traces[1], true);
    this.footprints = walk.footprints.map(node);
    this.passed = [];
    this.data = walk.data ? this.unpack(walk.data) : null;
  }
  unpack(data) {
    const all = { t: new Float64Array(bytes(data.t).buffer) };
    for (const name of ["arc", "joints", "rates", "loads", "points", "contact"]) {
      const flat = new Float32Array(bytes(data[name]).buffer);
      const width = flat.length / all.t.length;
      all[name] = Array.from(all.t, (_, k) => flat.subarray(k * width, (k + 1) * width));
    }
    return all;
  }
  // the pose at t [s], by cubic Hermite interpolation; loads are those of the last node
  at(t) {
    const d = this.data;
    let low = 0, high = d.t.length - 1;
    t = Math.min(Math.max(t, d.t[0]), d.t[high]);
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (d.t[middle] <= t) low = middle; else high = middle - 1;
    }
    const i = low, k = Math.min(low + 1, d.t.length - 1);
    const h = d.t[k] - d.t[i];
    const s = h > 0 ? (t - d.t[i]) / h : 0, r = 1 - s;
    const joints = Array.from(d.joints[i], (a, j) =>
      r * r * (1 + 2 * s) * a + s * s * (3 - 2 * s) * d.joints[k][j]
        + h * s * r * (r * d.rates[i][j] - s * d.rates[k][j]));
    const points = Array.from(d.points[i], (a, j) => r * a + s * d.points[k][j]);
    this.passed = d.points.slice(0, i + 1).map((p, j) => ({ p, arc: d.arc[j][0] }));
    return { t, joints, loads: d.loads[i], points, contact: d.contact[i], arc: d.arc[i][0] };
  }
  show(pose) {
    const w = this.walk, support = w.supports[pose.arc];
    this.joints.forEach((j, k) => {
      const value = pose.joints[k], [x, y, z] = j.axis;
      if (j.type === "revolute") {
        const s = Math.sin(0.5 * value);
        j.object.quaternion.set(s * x, s * y, s * z, Math.cos(0.5 * value));
      } else {
        j.object.position.set(...j.origin.map((o, a) => o + value * j.axis[a]));
      }
    });
    this.legs.forEach((leg, k) => leg.forEach((material) =>
      material.color.setHex(k === support.stance ? w.colours[0] : w.colours[1])));
    this.footprints.forEach((print, k) => { print.visible = k <= pose.arc; });
    this.push(pose);
    const here = [...this.passed, { p: pose.points, arc: pose.arc }];
    this.hip.fill(here.map(({ p, arc }) => ({ x: p[0], z: p[1], arc })));
    this.foot.fill(here.map(({ p, arc }) => ({ x: p[2], z: p[3], arc })));
  }
  // arrows: the ground's forces on both feet, a ring around every joint that is pushed
  push(pose) {
    const w = this.walk, [tangent, normal, ...zeta] = pose.loads;
    const [x, z, otherTangent, otherNormal, slips] = pose.contact;
    this.slips = slips > 0;
    this.cut = this.arrows[0].show(x, z, tangent, normal);
    this.arrows[1].show(pose.points[2], pose.points[3], otherTangent, otherNormal);
    this.rings.forEach((ring, k) => {
      const radius = w.metres_per_newton_metre * Math.abs(zeta[k]);
      ring.visible = radius > 0;
      if (ring.visible) ring.scale.set(Math.sign(zeta[k]) * radius, radius, radius);
    });
  }
}

// -- camera ----------------------------------------------------------------------------------------
let view = scene.view, followed = { x: 0, z: 0 };
for (const kind of Object.values(scene.views)) {
  viewer.controls.dispose();
  kind.commands.forEach(command);
  kind.camera = viewer.camera;
}
function look(kind) {
  view = kind;
  viewer.controls.dispose();
  viewer.set_camera(scene.views[kind].camera);
  viewer.camera.position.set(...scene.views[kind].position);
  viewer.controls.target.set(...scene.views[kind].target);
  followed = { x: 0, z: 0 };
  viewer.controls.update();
  element("view").textContent = kind === "side" ? "perspective" : "side view";
  viewer.set_3d_pane_size();
  viewer.set_dirty();
}
const eye = node(scene.follow);
// z of a smooth line through the footholds at x
function level(x) {
  const { supports, fall } = leader.walk;
  const above = (s) => s.z + fall * s.x;
  const next = supports.findIndex((s) => s.x > x);
  if (next < 0) return above(supports[supports.length - 1]) - fall * x;
  const b = supports[next], a = supports[Math.max(next - 1, 0)];
  const share = b.x > a.x ? (x - a.x) / (b.x - a.x) : 0;
  return (1 - share) * above(a) + share * above(b) - fall * x;
}
// the camera goes along with the robot
function follow() {
  const x = eye.position.x, z = level(x);
  for (const place of [viewer.camera.position, viewer.controls.target]) {
    place.x += x - followed.x;
    place.y += z - followed.z; // the viewer's own world has y up
  }
  followed = { x, z };
  viewer.camera.updateMatrixWorld();
}
const render = viewer.render.bind(viewer);
viewer.render = () => { follow(); render(); };
