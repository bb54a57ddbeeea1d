// The corners of a glTF file's triangles in the world at a time of an animation, as three.js has them:
// `node animated_models.mjs THREE MODEL ANIMATION SECONDS OUT`, where THREE is the folder of that package.
import { readFileSync, writeFileSync } from "node:fs";
import { dirname, join, resolve } from "node:path";
import { pathToFileURL } from "node:url";

const [three, model, animation, seconds, out] = process.argv.slice(2);
globalThis.self = globalThis;
globalThis.ProgressEvent ??= class extends Event {};
const folder = resolve(three);
const THREE = await import(pathToFileURL(join(folder, "build/three.module.js")));
const { GLTFLoader } = await import(pathToFileURL(join(folder, "examples/jsm/loaders/GLTFLoader.js")));

const bytes = readFileSync(model);
let json, own;
if (bytes.subarray(0, 4).toString() === "glTF") {
  const length = bytes.readUInt32LE(12);
  json = JSON.parse(bytes.subarray(20, 20 + length).toString());
  own = bytes.subarray(20 + length + 8);
} else {
  json = JSON.parse(bytes.toString());
}
// Geometry alone: buffers in place, no materials, which would need images.
for (const buffer of json.buffers ?? []) {
  if (buffer.uri?.startsWith("data:")) continue;
  const held = buffer.uri === undefined ? own : readFileSync(join(dirname(model), decodeURIComponent(buffer.uri)));
  buffer.uri = "data:application/octet-stream;base64," + held.toString("base64");
}
for (const field of ["materials", "textures", "images", "extensionsRequired", "extensionsUsed"]) delete json[field];
for (const mesh of json.meshes ?? []) for (const primitive of mesh.primitives) delete primitive.material;

const gltf = await new Promise((done, failed) => new GLTFLoader().parse(JSON.stringify(json), "", done, failed));
// Rotations are unit quaternions, but some files round them to three digits, and three.js takes them as they are.
for (const track of gltf.animations.flatMap((clip) => clip.tracks)) {
  const isSpline = track.createInterpolant.isInterpolantFactoryMethodGLTFCubicSpline;
  if (track.ValueTypeName !== "quaternion" || isSpline) continue;
  for (let at = 0; at < track.values.length; at += 4) {
    const length = Math.hypot(...track.values.slice(at, at + 4));
    for (let part = 0; part < 4; part++) track.values[at + part] /= length;
  }
}
const mixer = new THREE.AnimationMixer(gltf.scene);
const action = mixer.clipAction(gltf.animations[Number(animation)]);
action.setLoop(THREE.LoopOnce);
action.clampWhenFinished = true;
action.play();
mixer.setTime(Number(seconds));
gltf.scene.updateMatrixWorld(true);

const corners = [];
const at = new THREE.Vector3();
gltf.scene.traverse((mesh) => {
  if (!mesh.isMesh) return;
  mesh.skeleton?.update();
  const { index, attributes } = mesh.geometry;
  const count = index ? index.count : attributes.position.count;
  for (let corner = 0; corner < count - (count % 3); corner++) {
    mesh.getVertexPosition(index ? index.getX(corner) : corner, at);
    at.applyMatrix4(mesh.matrixWorld);
    corners.push(at.x, at.y, at.z);
  }
});
writeFileSync(out, Buffer.from(new Float64Array(corners).buffer));
