// The form of a scene object. Fields are texts. Lengths are in meters, angles in degrees. Pure.

import { no_number, number_in } from '../frame/number_text';
import { shape_of, type SceneObject } from '../server/messages';
import { kText } from '../strings';

const kWords = kText.scene;

export type Kind = 'box' | 'cylinder' | 'sphere';
export const kKinds: readonly Kind[] = ['box', 'cylinder', 'sphere'];

/** The server's limits for an object's name (`ObjectRequest` in /openapi.json). */
export const kLongestName = 128;
const kNotInNames = /[\u0000-\u001f\u007f/\\]/u;

/** Returns what is wrong with a name, or null. */
export function fault_of_name(text: string): string | null {
  const name = text.trim();
  if (name === '') return kWords.name_missing;
  const found = kNotInNames.exec(name)?.[0];
  if (found !== undefined) return kWords.name_character(found < ' ' || found === '\u007f' ? kWords.control_character : found);
  if (name === '.' || name === '..') return kWords.name_dots(name);
  return [...name].length > kLongestName ? kWords.name_long(kLongestName) : null;
}

export interface Form { name: string; kind: Kind; values: Record<string, string> }
/** Input that is not saved yet. Fields without such input follow the object. */
export type Edits = Partial<Form>;

type Field = readonly [key: string, label: string, step: number];
interface Fields { legend: string; keys: readonly Field[] }

const kSizes: Record<Kind, Fields> = {
  box: { legend: kWords.size, keys: [['size_x', 'x', 0.01], ['size_y', 'y', 0.01], ['size_z', 'z', 0.01]] },
  cylinder: { legend: kWords.size_along_z, keys: [['radius', 'radius', 0.01], ['length', 'length', 0.01]] },
  sphere: { legend: kWords.size, keys: [['radius', 'radius', 0.01]] },
};
const kPose: readonly Fields[] = [
  { legend: kWords.position, keys: [['x', 'x', 0.05], ['y', 'y', 0.05], ['z', 'z', 0.05]] },
  { legend: kWords.rotation, keys: [['roll', 'roll', 5], ['pitch', 'pitch', 5], ['yaw', 'yaw', 5]] },
];

export function fields_of(kind: Kind): readonly Fields[] {
  return [kSizes[kind], ...kPose];
}

export function blank_form(): Form {
  const values = { size_x: '0.2', size_y: '0.2', size_z: '0.2', radius: '0.1', length: '0.3', x: '0', y: '0', z: '0.5', roll: '0', pitch: '0', yaw: '0' };
  return { name: '', kind: 'box', values };
}

export function form_of(object: SceneObject): Form {
  const form = blank_form();
  const shape = shape_of(object);
  const put = (keys: readonly string[], values: readonly number[]) => keys.forEach((key, i) => { form.values[key] = text_of(values[i] ?? 0); });
  if (shape?.kind === 'box') put(['size_x', 'size_y', 'size_z'], shape.size);
  if (shape?.kind === 'cylinder') put(['radius', 'length'], [shape.radius, shape.length]);
  if (shape?.kind === 'sphere') put(['radius'], [shape.radius]);
  put(['x', 'y', 'z'], object.xyz);
  put(['roll', 'pitch', 'yaw'], object.rpy.map((angle) => (angle * 180) / Math.PI));
  return { ...form, name: object.name, kind: shape && shape.kind !== 'mesh' ? shape.kind : 'box' };
}

export function with_edits(form: Form, edits: Edits): Form {
  return { ...form, ...edits, values: { ...form.values, ...edits.values } };
}

/** Returns the edits that the user made after `sent` was sent. `sent` is saved now. */
export function edits_since(sent: Form, edits: Edits): Edits {
  const later: Edits = { values: {} };
  if (edits.name !== undefined && edits.name.trim() !== sent.name.trim()) later.name = edits.name;
  if (edits.kind !== undefined && edits.kind !== sent.kind) later.kind = edits.kind;
  for (const [key, text] of Object.entries(edits.values ?? {})) if (text !== sent.values[key]) later.values![key] = text;
  return later;
}

function text_of(value: number): string {
  return String(Number(value.toFixed(6)));
}

/**
 * Returns the object, or the faults of the form. Sizes are not checked here; the server checks
 * them.
 */
export function object_of(form: Form): SceneObject | { fault: string } {
  const faults: string[] = [];
  const number_of = (key: string): number => {
    const text = form.values[key] ?? '';
    const value = number_in(text);
    if (value === null) faults.push(kWords.field_fault(key.replace('_', ' '), no_number(text)));
    return value ?? NaN;
  };
  const name_fault = fault_of_name(form.name);
  if (name_fault !== null) faults.push(name_fault);
  const radians_of = (key: string) => (number_of(key) * Math.PI) / 180;
  const pose = {
    xyz: [number_of('x'), number_of('y'), number_of('z')] as [number, number, number],
    rpy: [radians_of('roll'), radians_of('pitch'), radians_of('yaw')] as [number, number, number],
  };
  const name = form.name.trim();
  const object: SceneObject = form.kind === 'box'
    ? { name, box: [number_of('size_x'), number_of('size_y'), number_of('size_z')], ...pose }
    : form.kind === 'cylinder' ? { name, cylinder: [number_of('radius'), number_of('length')], ...pose }
      : { name, sphere: [number_of('radius')], ...pose };
  return faults.length > 0 ? { fault: faults.join('; ') } : object;
}
