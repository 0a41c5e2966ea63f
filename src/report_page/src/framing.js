// Where to look from: which way is up, what to get into the picture, and from how far.
import { Vector3, Quaternion, Matrix4 } from "three";

export const kAxes = [new Vector3(1, 0, 0), new Vector3(0, 1, 0), new Vector3(0, 0, 1)];

/** Pose of a body in a row as a matrix; identity where there is none. */
export function matrixOf(run, row, body, out = new Matrix4()) {
  const p = run.pose(row, body);
  if (!p) return out.identity();
  return out.compose(new Vector3(p[4], p[5], p[6]), new Quaternion(p[0], p[1], p[2], p[3]), new Vector3(1, 1, 1));
}

/** The positive axis of the world that a direction is nearest to. */
function nearestAxis(v) {
  const size = v.toArray().map(Math.abs);
  return kAxes[size.indexOf(Math.max(...size))];
}

/** What is known of directions in the world: anatomical ones where the scene names them, else guesses that look right. */
export function directions(run) {
  const row = run.shown(0);
  const knee = run.raw.joints.find((j) => j.femur);
  if (knee) {
    const bone = run.bodies[knee.tibia.body].fixed ? knee.tibia : knee.femur;
    const m = matrixOf(run, row, bone.body);
    const up = new Vector3(...bone.proximal).transformDirection(m), front = new Vector3(...bone.anterior).transformDirection(m);
    const right = front.clone().cross(up);  // of the patient
    return { up, front, side: knee.right ? right : right.negate(), named: true };
  }
  const sum = new Vector3(), push = new Vector3();
  for (const c of run.contacts)
    for (let k = 0; k < run.rows; ++k)
      if (run.contactForce(c, k) > 0) sum.add(push.fromArray(c.force, 3 * k).transformDirection(matrixOf(run, k, c.body_b)).multiplyScalar(run.contactForce(c, k)));
  if (sum.lengthSq() === 0 && run.raw.gravity) sum.fromArray(run.raw.gravity);
  if (sum.lengthSq() === 0) {
    for (const l of run.raw.ligaments) {
      const [a, b] = [l.path[0], l.path[l.path.length - 1]].map((e) => new Vector3(...e.point).applyMatrix4(matrixOf(run, row, e.body)));
      const d = b.sub(a);
      sum.add(new Vector3(...d.toArray().map(Math.abs)));
    }
  }
  let up = sum.lengthSq() > 0 ? nearestAxis(sum) : kAxes[1];
  const hinge = run.raw.joints[0] ? new Vector3(...run.raw.joints[0].axis) : kAxes[2];
  let side = nearestAxis(hinge);
  if (side === up && run.raw.joints.every((j) => j.type === "revolute")) up = kAxes[(kAxes.indexOf(side) + 2) % 3];
  if (side === up) side = kAxes[(kAxes.indexOf(up) + 1) % 3];
  const front = up.clone().cross(side);
  // The positive one of the two ways: x is the front of most scenes.
  if (front.toArray().some((v) => v < 0)) front.negate();
  return { up: up.clone(), front, side: side.clone(), named: false };
}

/** Looks along -direction at `points` so that all of them fit. */
/** `free`: the share of the picture's height that is theirs; the rest, at the bottom, is for legends. */
export function frame(camera, controls, points, direction, up, free = 1) {
  if (points.length === 0) points = [new Vector3(-10, -10, -10), new Vector3(10, 10, 10)];
  const z = direction.clone().normalize(), x = up.clone().cross(z);
  if (x.lengthSq() < 1e-6) x.copy(kAxes[0]).cross(z);
  if (x.lengthSq() < 1e-6) x.copy(kAxes[1]).cross(z);
  x.normalize();
  const y = z.clone().cross(x);
  const ends = [x, y, z].map((axis) => {
    const at = points.map((p) => p.dot(axis));
    return at.reduce((e, v) => [Math.min(e[0], v), Math.max(e[1], v)], [Infinity, -Infinity]);
  });
  const middle = new Vector3();
  [x, y, z].forEach((axis, i) => middle.addScaledVector(axis, (ends[i][0] + ends[i][1]) / 2));
  const half = Math.tan((camera.fov * Math.PI) / 360), tanY = half * free, tanX = half * camera.aspect;
  let distance = 0;
  const from = new Vector3();
  for (const p of points) {
    from.subVectors(p, middle);
    distance = Math.max(distance, from.dot(z) + Math.max(Math.abs(from.dot(x)) / tanX, Math.abs(from.dot(y)) / tanY));
  }
  const size = Math.max(...ends.map((e) => e[1] - e[0]), 1e-3);
  distance = Math.max(distance * 1.07, size * 0.5);
  camera.up.copy(up);
  camera.position.copy(middle).addScaledVector(z, distance);
  camera.near = distance / 200;
  camera.far = distance + 20 * size;
  camera.updateProjectionMatrix();
  controls.target.copy(middle);
  controls.update();
  return size;
}
