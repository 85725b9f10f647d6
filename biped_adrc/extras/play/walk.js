// A live walk in Meshcat's viewer: robots, the ground that goes along with them, and the hand.
const TRAIL = 240; // points of a trace: four seconds

class LiveRobot extends Robot {
  constructor(walk) {
    super(walk);
    const [first] = walk.supports, { x, z } = this.footprints[0].position;
    this.under = { x: x - first.x, z: z - first.z };
    this.prints = [];
  }
  show(pose) {
    this.walk.supports = [pose.support];
    super.show({ ...pose, arc: 0 });
    this.stand(pose.support);
    this.passed.push({ p: pose.points, arc: 0 });
    if (this.passed.length > TRAIL) this.passed.shift();
  }
  // footprints of the last supports; after a step back those that are not there any more go
  stand(support) {
    this.prints = this.prints.filter((s) => s.number < support.number);
    this.prints.push(support);
    this.prints.splice(0, this.prints.length - this.footprints.length);
    this.footprints.forEach((print, k) => {
      const s = this.prints[k];
      print.visible = s !== undefined;
      if (s) print.position.set(s.x + this.under.x, 0, s.z + this.under.z);
      if (s) print.rotation.y = s.slope;
    });
  }
  forget() {
    this.passed.length = 0;
  }
}
const robots = scene.walks.map((walk) => new LiveRobot(walk));
const leader = robots[0];
const roots = [0, 1].map((k) => node("meshcat/robots/" + k));

// the tiles repeat after a metre; they are drawn on the slope of the start
const drawnSlope = Math.atan(leader.walk.fall);
function moveGround({ x, z, slope }) {
  const whole = Math.round(x), ground = node("meshcat/ground");
  leader.walk.fall = Math.tan(slope);
  ground.position.set(whole, 0, z + leader.walk.fall * (x - whole));
  ground.rotation.y = slope - drawnSlope;
}

const hand = {
  arrow: new Arrow(scene.hand.arrow, { ...leader.walk, ground: 0 }),
  line: new Trace(scene.hand.line, false),
};
// acting: where the hand holds the robot, its force and the spring's other end; null for none
function drawHand(acting) {
  const text = element("force"), { at: [x, z], force: [fx, fz], anchor } = acting || { at: [0, 0], force: [0, 0], anchor: null };
  hand.arrow.show(x, z, fx, fz);
  node(scene.hand.line).visible = anchor !== null;
  if (anchor) hand.line.fill([{ x, z }, { x: anchor[0], z: anchor[1] }]);
  text.hidden = acting === null;
  if (text.hidden) return;
  const at = roots[0].localToWorld(new THREE.Vector3(x, 0, z)).project(viewer.camera);
  text.style.left = 0.5 * (at.x + 1) * pane.clientWidth + 14 + "px";
  text.style.top = 0.5 * (1 - at.y) * pane.clientHeight - 28 + "px";
  text.textContent = Math.hypot(fx, fz).toFixed(0) + " N";
}

function drawWalks(message) {
  if (message.t < drawWalks.t) robots.forEach((robot) => robot.forget());
  drawWalks.t = message.t;
  roots.forEach((root, k) => { root.visible = k < message.walks.length; });
  message.walks.forEach((pose, k) => robots[k].show(pose));
  moveGround(message.walks[0].support);
  follow(); // the hand aims between two pictures too
  drawHand(message.hand);
  viewer.set_dirty();
}
drawWalks.t = 0;
// nothing is shown before the first pose, which scales the arrows
for (const root of [...roots, node(scene.hand.arrow), node(scene.hand.line)]) root.visible = false;
// the ground below its footprints, these below the traces
viewer.renderer.layers.set(node("meshcat/ground"), 0);
for (const { footprints, hip, foot } of robots) {
  footprints.forEach((print) => viewer.renderer.layers.set(print, 1));
  [hip, foot].forEach(({ line }) => viewer.renderer.layers.set(line, 2));
}
