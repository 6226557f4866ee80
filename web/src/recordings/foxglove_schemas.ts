// JSON schemas of the messages in an exported MCAP file. Foxglove recognizes a schema by its name.
// The members are those of Foxglove's documentation.

const time = { type: 'object', title: 'time', properties: { sec: { type: 'integer', minimum: 0 }, nsec: { type: 'integer', minimum: 0, maximum: 999_999_999 } } };
const duration = { type: 'object', title: 'duration', properties: { sec: { type: 'integer' }, nsec: { type: 'integer', minimum: 0, maximum: 999_999_999 } } };
const text = { type: 'string' };
const figure = { type: 'number' };
const flag = { type: 'boolean' };
const object = (properties: Record<string, object>) => ({ type: 'object', properties });
const list = (items: object) => ({ type: 'array', items });
const vector = object({ x: figure, y: figure, z: figure });
const quaternion = object({ x: figure, y: figure, z: figure, w: figure });
const pose = object({ position: vector, orientation: quaternion });
const color = object({ r: figure, g: figure, b: figure, a: figure });

export const kSchemas = {
  'foxglove.JointStates': object({ timestamp: time, joints: list(object({ name: text, position: figure })) }),
  'foxglove.FrameTransforms': object({
    transforms: list(object({ timestamp: time, parent_frame_id: text, child_frame_id: text, translation: vector, rotation: quaternion })),
  }),
  'foxglove.SceneUpdate': object({
    deletions: list(object({ timestamp: time, type: { type: 'integer' }, id: text })),
    entities: list(object({
      timestamp: time, frame_id: text, id: text, lifetime: duration, frame_locked: flag,
      metadata: list(object({ key: text, value: text })), arrows: list(object({})), lines: list(object({})), triangles: list(object({})), models: list(object({})),
      cubes: list(object({ pose, size: vector, color: color })), spheres: list(object({ pose, size: vector, color: color })),
      cylinders: list(object({ pose, size: vector, bottom_scale: figure, top_scale: figure, color: color })),
      texts: list(object({ pose, billboard: flag, font_size: figure, scale_invariant: flag, color: color, text })),
    })),
  }),
  'foxglove.Log': object({ timestamp: time, level: { type: 'integer' }, message: text, name: text, file: text, line: { type: 'integer' } }),
  'armloom.Event': object({ stream: text, seq: { type: 'integer' }, type: text, t_s: figure, at: text, data: object({}) }),
  'armloom.Job': object({ id: text, name: text, arms: list(text), state: text }),
} as const;
