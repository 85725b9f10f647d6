"use strict";
// Meshcat's scene by the pen of a canvas, the farthest part first: where no graphics processor is, WebGL takes ten
// times as long. It takes the place of the viewer's renderer, and knows the shapes that `view.meshcat.objects` makes.
const { THREE } = MeshCat;
const LIGHT = new THREE.Vector3(-0.5, 0.65, 0.6).normalize(); // towards it, in the camera's frame
const AMBIENT = 0.55, DIRECT = 0.5; // shares of a colour
const ROUND = Array.from({ length: 24 }, (_, k) => [Math.cos(k * Math.PI / 12), Math.sin(k * Math.PI / 12)]);
const ACROSS = [-1, -0.8, -0.4, 0, 0.4, 0.8, 1]; // places on a cylinder, where the gradient of its light has stops
const CORNERS = [0, 1, 2, 3, 4, 5, 6, 7].map((k) => [k & 1, k >> 1 & 1, k >> 2].map((b) => b - 0.5));
const SIDES = [[0, 1], [1, 2], [2, 0]].flatMap(([i, j]) => [-0.5, 0.5].map((side) => {
  const there = CORNERS.filter((c) => c[3 - i - j] === side).sort((a, b) => a[i] - b[i] || a[j] - b[j]);
  return [there[0], there[1], there[3], there[2]]; // around the side
}));

class Painter {
  constructor(place) {
    this.domElement = document.createElement("canvas");
    this.pen = this.domElement.getContext("2d", { alpha: false, willReadFrequently: true });
    this.layers = new Map(); // nodes whose parts are painted before the others, with a number for the order
    place.append(this.domElement);
  }
  setPixelRatio(ratio) { this.ratio = ratio; }
  setSize(w, h) {
    const { domElement: canvas, ratio } = this;
    Object.assign(canvas, { width: Math.round(w * ratio), height: Math.round(h * ratio) });
    Object.assign(canvas.style, { display: "block", width: w + "px", height: h + "px" });
  }
  render(scene, camera) {
    const { pen, domElement: { width, height } } = this, parts = [];
    scene.updateMatrixWorld();
    pen.globalAlpha = 1;
    pen.fillStyle = "#fff";
    pen.fillRect(0, 0, width, height);
    const collect = (object, before) => {
      if (!object.visible) return;
      const layer = this.layers.has(object) ? this.layers.get(object) : before;
      if (object.isMesh || object.isLine) parts.push(new Part(object, layer, camera, width, height));
      object.children.forEach((child) => collect(child, layer));
    };
    collect(scene, 9);
    parts.sort((a, b) => a.layer - b.layer || a.depth - b.depth).forEach((part) => part.paint(pen));
  }
}

// one shape in the camera's frame
class Part {
  constructor(object, layer, camera, width, height) {
    const { geometry: { type, parameters } } = object, { matrixWorldInverse, projectionMatrix: { elements } } = camera;
    Object.assign(this, { object, layer, type, parameters, width, height, p: elements, flat: camera.isOrthographicCamera });
    this.m = new THREE.Matrix4().multiplyMatrices(matrixWorldInverse, object.matrixWorld);
    this.middle = new THREE.Vector3().setFromMatrixPosition(this.m);
    const [radius] = this.radii = type === "SphereGeometry" ? [parameters.radius] : [0, 0];
    if (type === "CylinderGeometry") this.radii = [parameters.radiusBottom, parameters.radiusTop];
    const [x, y, z] = this.m.elements;
    this.scale = Math.hypot(x, y, z);
    this.depth = this.middle.z + this.scale * Math.max(...this.radii, radius); // nearer is more
  }
  paint(pen) {
    const { material } = this.object;
    pen.globalAlpha = material.opacity;
    if (this.object.isLine) this.line(pen, material);
    else if (this.type === "SphereGeometry") this.ball(pen);
    else if (this.type === "CylinderGeometry") this.cylinder(pen);
    else if (this.type === "BoxGeometry") this.box(pen);
    else this.mesh(pen);
  }
  // [px] of a point of the camera's frame; null behind the camera
  pixel({ x, y, z }) {
    const { p, width, height } = this, w = p[11] * z + p[15];
    return w > 0 ? [0.5 * width * (1 + (p[0] * x + p[8] * z + p[12]) / w), 0.5 * height * (1 - (p[5] * y + p[9] * z + p[13]) / w)] : null;
  }
  at(x, y, z) { return new THREE.Vector3(x, y, z).applyMatrix4(this.m); }
  view(point) { return this.flat ? new THREE.Vector3(0, 0, 1) : point.clone().negate().normalize(); }
  colour(normal) {
    const { color, emissive } = this.object.material, light = AMBIENT + DIRECT * Math.max(0, normal.dot(LIGHT));
    const of = (name) => Math.min(255, Math.round(255 * (light * color[name] + (emissive ? emissive[name] : 0))));
    return "rgb(" + of("r") + "," + of("g") + "," + of("b") + ")";
  }
  fill(pen, points, style) {
    const places = points.map((point) => this.pixel(point));
    if (places.includes(null)) return;
    pen.fillStyle = style;
    pen.beginPath();
    places.forEach(([x, y]) => pen.lineTo(x, y));
    pen.fill();
  }
  cylinder(pen) {
    const { parameters: { height }, radii, scale } = this, ends = [this.at(0, -height / 2, 0), this.at(0, height / 2, 0)];
    const axis = ends[1].clone().sub(ends[0]).normalize(), view = this.view(this.middle);
    const side = axis.clone().cross(view);
    if (side.length() < 1e-6) side.set(1, 0, 0);
    side.normalize();
    const front = side.clone().cross(axis), place = (end, c, s) => ends[end].clone().addScaledVector(side, c * scale * radii[end]).addScaledVector(front, s * scale * radii[end]);
    const thick = radii[0] > radii[1] ? 0 : 1, [from, to] = [place(thick, -1, 0), place(thick, 1, 0)].map((point) => this.pixel(point));
    if (!from || !to) return;
    const style = pen.createLinearGradient(...from, ...to);
    for (const s of ACROSS) style.addColorStop(0.5 + 0.5 * s, this.colour(side.clone().multiplyScalar(s).addScaledVector(front, Math.sqrt(1 - s * s))));
    this.fill(pen, [place(0, -1, 0), place(1, -1, 0), place(1, 1, 0), place(0, 1, 0)], style);
    const slant = axis.dot(view), near = slant > 0 ? 1 : 0;
    if (Math.abs(slant) < 1e-3) return;
    this.fill(pen, ROUND.map(([c, s]) => place(1 - near, c, s)), style);
    this.fill(pen, ROUND.map(([c, s]) => place(near, c, s)), this.colour(near ? axis : axis.clone().negate()));
  }
  ball(pen) {
    const r = this.scale * this.radii[0], { middle } = this, edge = middle.clone(), spot = middle.clone().addScaledVector(LIGHT, r);
    edge.x += r;
    const [at, rim, bright] = [middle, edge, spot].map((point) => this.pixel(point));
    if (!at || !rim || !bright) return;
    const style = pen.createRadialGradient(...bright, 0, ...at, rim[0] - at[0]);
    for (const s of [0, 0.25, 0.5, 0.75, 1]) style.addColorStop(s, this.colour(LIGHT.clone().multiplyScalar(Math.cos(s * Math.PI / 2))));
    pen.fillStyle = style;
    pen.beginPath();
    pen.arc(...at, rim[0] - at[0], 0, 2 * Math.PI);
    pen.fill();
  }
  box(pen) {
    const { width, height, depth } = this.parameters;
    for (const corners of SIDES) {
      const points = corners.map(([x, y, z]) => this.at(x * width, y * height, z * depth));
      const normal = points[1].clone().sub(points[0]).cross(points[3].clone().sub(points[0])).normalize();
      const middle = points[0].clone().add(points[2]).multiplyScalar(0.5);
      if (normal.dot(middle.clone().sub(this.middle)) < 0) normal.negate();
      if (normal.dot(this.view(middle)) > 1e-6) this.fill(pen, points, this.colour(normal));
    }
  }
  // all triangles as one path, which has no seams
  mesh(pen) {
    const { index, attributes: { position: { array } } } = this.object.geometry;
    const points = Array.from(index.array, (k) => this.pixel(this.at(...array.subarray(3 * k, 3 * k + 3))));
    pen.fillStyle = this.colour(LIGHT);
    pen.beginPath();
    points.forEach((point, k) => point && (k % 3 ? pen.lineTo(...point) : pen.moveTo(...point)));
    pen.fill();
  }
  // pairs of points; most begin where the one before ends
  line(pen, { color }) {
    const { drawRange, attributes: { position: { array, count } } } = this.object.geometry;
    pen.strokeStyle = color.getStyle();
    pen.lineWidth = 1;
    pen.beginPath();
    for (let k = 0; k < 3 * Math.min(drawRange.count, count); k += 3) {
      if (k > 0 && k % 2 === 0 && array[k] === array[k - 3] && array[k + 2] === array[k - 1]) continue;
      const point = this.pixel(this.at(array[k], array[k + 1], array[k + 2]));
      if (point) (k % 2 ? pen.lineTo(...point) : pen.moveTo(...point));
    }
    pen.stroke();
  }
}
