// The mouse or a finger: a drag that begins on the robot pulls it by a spring, another one turns the camera.
const ray = new THREE.Raycaster();
const AROUND = [[0, 0], [8, 0], [-8, 0], [0, 8], [0, -8], [6, 6], [-6, 6], [6, -6], [-6, -6]]; // [px] that a pointer may miss by
const parts = new Map(scene.links.map(([path, link]) => [node(path), link]));
let selected = null, pull = null;

function aim({ clientX, clientY }) {
  const box = pane.getBoundingClientRect();
  const x = (clientX - box.left) / box.width, y = (clientY - box.top) / box.height;
  ray.setFromCamera({ x: 2 * x - 1, y: 1 - 2 * y }, viewer.camera);
}

// the link under the pointer or just beside it, and the point of it (x, z) [m] in its frame and in the plane of the
// walk; null for none
function pick({ clientX, clientY }) {
  viewer.scene.updateMatrixWorld(true);
  for (const [dx, dy] of AROUND) {
    aim({ clientX: clientX + dx, clientY: clientY + dy });
    const [hit] = ray.intersectObjects([...parts.keys()], true);
    if (!hit) continue;
    let part = hit.object;
    while (!parts.has(part)) part = part.parent;
    const at = part.parent.worldToLocal(hit.point.clone()), place = roots[0].worldToLocal(hit.point);
    return { link: parts.get(part), at: [at.x, at.z], place: [place.x, place.z] };
  }
  return null;
}

// where the pointer is in the plane of the walk (x, z) [m]
function pointed(event) {
  aim(event);
  const from = roots[0].worldToLocal(ray.ray.origin.clone());
  const to = roots[0].worldToLocal(ray.ray.origin.clone().add(ray.ray.direction));
  const along = to.sub(from), s = -from.y / along.y;
  return Number.isFinite(s) ? [from.x + s * along.x, from.z + s * along.z] : null;
}

function select(found) {
  selected = found;
  element("link").value = found ? found.link : scene.robot.trunk;
  for (const [part, link] of parts) {
    part.traverse(({ material }) => {
      if (material && material.emissive) material.emissive.setHex(found && found.link === link ? 0x662200 : 0);
    });
  }
  viewer.set_dirty();
}

// the anchor goes as the pointer goes: wherever the drag began, the spring is slack there
function sendPull(event) {
  const at = pointed(event);
  pull.event = event;
  if (at) send({ do: "pull", link: pull.link, at: pull.at, anchor: at.map((y, k) => y + pull.away[k]) });
}
// the camera goes along with the robot, and the pointer with the camera
function keepPulling() {
  if (pull) sendPull(pull.event);
}
function release() {
  if (!pull) return;
  pull = null;
  send({ do: "let_go" });
}

pane.addEventListener("pointerdown", (event) => {
  if (![0, 2].includes(event.button)) return;
  const found = pick(event), at = pointed(event);
  if (!found || at === null) {
    select(null);
    return;
  }
  event.stopImmediatePropagation(); // the camera stays
  event.preventDefault();
  select(found);
  pane.setPointerCapture(event.pointerId);
  pull = { ...found, away: found.place.map((y, k) => y - at[k]) };
  sendPull(event);
}, true);
pane.addEventListener("contextmenu", (event) => event.preventDefault());
pane.addEventListener("pointermove", (event) => {
  if (pull) sendPull(event);
});
for (const end of ["pointerup", "pointercancel", "lostpointercapture"]) pane.addEventListener(end, release);
addEventListener("blur", release);
