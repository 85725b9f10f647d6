"use strict";
// Meshcat's scene by the pen of a canvas, the farthest part first: where there is no graphics processor, WebGL takes
// ten times as long. It takes the place of the viewer's renderer, and knows the shapes of `view.meshcat.objects`.
const { THREE } = MeshCat;
const LIGHT = new THREE.Vector3(-0.5, 0.65, 0.6).normalize(); // towards it, in the frame of the camera
const AMBIENT = 0.6, DIRECT = 0.55; // shares of a colour
const TURNS = Array.from({ length: 24 }, (_, k) => [Math.cos(k * Math.PI / 12), Math.sin(k * Math.PI / 12)]);
const STOPS = [-1, -0.8, -0.4, 0, 0.4, 0.8, 1]; // places across a cylinder where its light is computed
const FLAT = 1e-3; // cosine of a direction that lies in the picture
const sum = (point, ...terms) => terms.reduce((p, [s, direction]) => p.addScaledVector(direction, s), point.clone());

class Painter {
  constructor(place) {
    this.domElement = document.createElement("canvas");
    // offscreen: its pictures go to the screen without those of the page
    this.pen = this.domElement.transferControlToOffscreen().getContext("2d", { alpha: false, willReadFrequently: true });
    this.layers = new Map(); // nodes whose parts are painted before all others, with a number for their order
    place.append(this.domElement);
  }
  setPixelRatio(ratio) { this.ratio = ratio; }
  setSize(w, h) {
    const { domElement: { style }, pen: { canvas }, ratio } = this;
    Object.assign(canvas, { width: Math.round(w * ratio), height: Math.round(h * ratio) });
    Object.assign(style, { display: "block", width: w + "px", height: h + "px" });
    this.blank(); // another size has made it black
  }
  blank() { Object.assign(this.pen, { globalAlpha: 1, fillStyle: "#fff" }).fillRect(0, 0, this.pen.canvas.width, this.pen.canvas.height); }
  render(scene, camera) {
    const { pen, layers } = this, parts = [];
    scene.updateMatrixWorld();
    this.blank();
    const collect = (node, above) => {
      if (!node.visible) return;
      const layer = layers.has(node) ? layers.get(node) : above;
      if (node.isMesh || node.isLine) parts.push(new Part(node, layer, camera, pen));
      node.children.forEach((child) => collect(child, layer));
    };
    collect(scene, Infinity);
    parts.sort((a, b) => (a.layer === b.layer ? a.depth - b.depth : a.layer - b.layer)).forEach((part) => part.paint());
  }
}

// one shape, in the frame of the camera
class Part {
  constructor({ matrixWorld, geometry, material }, layer, camera, pen) {
    const m = new THREE.Matrix4().multiplyMatrices(camera.matrixWorldInverse, matrixWorld), { parameters: size = {} } = geometry;
    Object.assign(this, { geometry, material, layer, pen, size, m, p: camera.projectionMatrix.elements, flat: camera.isOrthographicCamera });
    this.middle = new THREE.Vector3().setFromMatrixPosition(m);
    this.radii = [size.radiusBottom, size.radiusTop, size.radius].map((r) => (r || 0) * Math.hypot(...m.elements.slice(0, 3)));
    this.depth = this.middle.z + Math.max(...this.radii); // nearer is more
  }
  paint() {
    const kinds = { SphereGeometry: "ball", CylinderGeometry: "cylinder" };
    this.pen.globalAlpha = this.material.opacity;
    this[this.material.isLineBasicMaterial ? "line" : kinds[this.geometry.type] || "faces"]();
  }
  // [px] of a point; null behind the camera
  pixel({ x, y, z }) {
    const { p, pen: { canvas: { width, height } } } = this, w = p[11] * z + p[15];
    return w > 0 ? [0.5 * width * (1 + (p[0] * x + p[8] * z + p[12]) / w), 0.5 * height * (1 - (p[5] * y + p[9] * z + p[13]) / w)] : null;
  }
  vertex(k) { return new THREE.Vector3().fromBufferAttribute(this.geometry.attributes.position, k).applyMatrix4(this.m); }
  // from a point towards the camera
  view(point) { return this.flat ? new THREE.Vector3(0, 0, 1) : point.clone().negate().normalize(); }
  colour(normal) {
    const { color, emissive } = this.material, light = AMBIENT + DIRECT * Math.max(0, normal.dot(LIGHT));
    return "rgb(" + ["r", "g", "b"].map((c) => Math.round(255 * (light * color[c] + emissive[c]))) + ")";
  }
  gradient(kind, places, stops) {
    if (places.flat().includes(null)) return null;
    const style = this.pen["create" + kind + "Gradient"](...places.flat());
    stops.forEach(([at, normal]) => style.addColorStop(at, this.colour(normal)));
    return style;
  }
  // polygons of so many corners as one path, which has no seams
  fill(points, style, corners = points.length) {
    const places = points.map((point) => this.pixel(point)), { pen } = this;
    if (places.includes(null)) return;
    pen.fillStyle = style;
    pen.beginPath();
    places.forEach((place, k) => (k % corners ? pen.lineTo(...place) : pen.moveTo(...place)));
    pen.fill();
  }
  // both ends and the rectangle between them; the light changes across
  cylinder() {
    const { size: { height }, radii, middle, m } = this, axis = new THREE.Vector3(0, 1, 0).transformDirection(m), view = this.view(middle);
    const side = axis.clone().cross(view), slant = axis.dot(view), long = 0.5 * height * new THREE.Vector3(m.elements[4], m.elements[5], m.elements[6]).length();
    if (side.length() < FLAT) side.set(1, 0, 0);
    const front = side.normalize().clone().cross(axis);
    const rim = (end, c, s) => sum(middle, [end ? long : -long, axis], [c * radii[end], side], [s * radii[end], front]);
    const thick = Number(radii[1] > radii[0]), near = Number(slant > 0), across = [-1, 1].map((s) => this.pixel(rim(thick, s, 0)));
    const style = this.gradient("Linear", across, STOPS.map((s) => [0.5 + 0.5 * s, sum(front, [-1, front], [s, side], [Math.sqrt(1 - s * s), front])]));
    if (!style) return;
    this.fill([rim(0, -1, 0), rim(1, -1, 0), rim(1, 1, 0), rim(0, 1, 0)], style);
    if (Math.abs(slant) < FLAT) return;
    this.fill(TURNS.map(([c, s]) => rim(1 - near, c, s)), style);
    this.fill(TURNS.map(([c, s]) => rim(near, c, s)), this.colour(axis.multiplyScalar(near ? 1 : -1)));
  }
  ball() {
    const { middle, pen, radii } = this, [r] = radii.slice(-1), spot = this.pixel(sum(middle, [r, LIGHT]));
    const [at, rim] = [middle, sum(middle, [r, new THREE.Vector3(1, 0, 0)])].map((point) => this.pixel(point));
    const style = at && this.gradient("Radial", [spot, 0, at, rim[0] - at[0]], [0, 0.25, 0.5, 0.75, 1].map((s) => [s, LIGHT.clone().multiplyScalar(1 - s * s)]));
    if (!style) return;
    pen.fillStyle = style;
    pen.beginPath();
    pen.arc(...at, rim[0] - at[0], 0, 2 * Math.PI);
    pen.fill();
  }
  // the sides of a box that are seen, or all triangles of a flat mesh
  faces() {
    const { geometry: { type, index, attributes: { normal } } } = this, box = type === "BoxGeometry", size = box ? 6 : index.count;
    for (let k = 0; k < index.count; k += size) {
      const first = index.array[k], view = this.view(this.vertex(first));
      const out = box ? new THREE.Vector3().fromBufferAttribute(normal, first).transformDirection(this.m) : view;
      if (out.dot(view) < FLAT) continue;
      this.fill(Array.from(index.array.slice(k, k + size), (i) => this.vertex(i)), box ? this.colour(out) : this.material.color.getStyle(), 3);
    }
  }
  // pairs of points; most begin where the one before ends
  line() {
    const { geometry: { drawRange, attributes: { position: { array, count } } }, material, pen } = this;
    pen.strokeStyle = material.color.getStyle();
    pen.lineWidth = 1;
    pen.beginPath();
    for (let k = 0; k < Math.min(drawRange.count, count); k += 1) {
      if (k > 0 && k % 2 === 0 && array[3 * k] === array[3 * k - 3] && array[3 * k + 2] === array[3 * k - 1]) continue;
      const place = this.pixel(this.vertex(k));
      if (place) (k % 2 ? pen.lineTo(...place) : pen.moveTo(...place));
    }
    pen.stroke();
  }
}
