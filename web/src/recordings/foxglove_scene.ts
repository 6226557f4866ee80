// Converts scene objects to Foxglove primitives in the frame `world`. Of a mesh only its pose and
// name are exported. Pure.

import { Euler, Quaternion } from 'three';
import { shape_of, type SceneObject } from '../server/messages';

const kColor = { r: 0.45, g: 0.5, b: 0.57, a: 1 };

export function scene_update(objects: readonly SceneObject[], timestamp: { sec: number; nsec: number }): object {
  return { deletions: [], entities: objects.map((object) => entity(object, timestamp)) };
}

function entity(object: SceneObject, timestamp: { sec: number; nsec: number }): object {
  const shape = shape_of(object);
  const [x = 0, y = 0, z = 0] = object.xyz;
  const [roll = 0, pitch = 0, yaw = 0] = object.rpy;
  const turn = new Quaternion().setFromEuler(new Euler(roll, pitch, yaw, 'ZYX'));
  const pose = { position: { x, y, z }, orientation: { x: turn.x, y: turn.y, z: turn.z, w: turn.w } };
  const size = (a: number, b: number, c: number) => ({ pose, size: { x: a, y: b, z: c }, color: kColor });
  return {
    timestamp, frame_id: 'world', id: object.name, lifetime: { sec: 0, nsec: 0 }, frame_locked: false, metadata: [],
    arrows: [], lines: [], triangles: [], models: [],
    cubes: shape?.kind === 'box' ? [size(...shape.size)] : [],
    spheres: shape?.kind === 'sphere' ? [size(2 * shape.radius, 2 * shape.radius, 2 * shape.radius)] : [],
    cylinders: shape?.kind === 'cylinder' ? [{ ...size(2 * shape.radius, 2 * shape.radius, shape.length), bottom_scale: 1, top_scale: 1 }] : [],
    texts: [{ pose, billboard: true, font_size: 0.05, scale_invariant: false, color: kColor, text: object.name }],
  };
}
