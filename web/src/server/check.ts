// Validates the server's JSON against the schemas in src/contract. Each fault states its place and
// the value found.

import { Validator } from '@cfworker/json-schema';
import { cut_text } from '../names';
import shapes from '../contract/schemas.json';
import type { components } from '../contract/types';

export type Schemas = components['schemas'];
type Checked = keyof Schemas & keyof typeof shapes;

export type Parsed<T> = { ok: true; value: T } | { ok: false; fault: string };

const validators = new Map<Checked, Validator>();

export function check<Name extends Checked>(name: Name, value: unknown): Parsed<Schemas[Name]> {
  if (value === undefined) return { ok: false, fault: '/: no value' };  // JSON cannot express undefined
  const { valid, errors } = validator_of(name).validate(value);
  if (valid) return { ok: true, value: value as Schemas[Name] };
  // Takes the error at the deepest place. Outer errors only repeat that there is an inner error.
  const depth = (place: string) => place.split('/').length;
  const fault = errors.reduce((a, b) => (depth(b.instanceLocation) >= depth(a.instanceLocation) ? b : a));
  const pointer = fault.instanceLocation.slice(1);
  const found = cut_text(JSON.stringify(value_at(value, pointer)) ?? 'nothing', 60);
  return { ok: false, fault: `${pointer || '/'}: ${fault.error} Found ${found}` };
}

function validator_of(name: Checked): Validator {
  let validator = validators.get(name);
  if (!validator) {
    validator = new Validator({ $ref: `#/$defs/${name}`, $defs: shapes as object }, '2020-12');
    validators.set(name, validator);
  }
  return validator;
}

function value_at(value: unknown, pointer: string): unknown {
  return pointer.split('/').slice(1).reduce<unknown>((at, key) => {
    const plain = decodeURIComponent(key).replaceAll('~1', '/').replaceAll('~0', '~');
    return typeof at === 'object' && at !== null ? (at as Record<string, unknown>)[plain] : undefined;
  }, value);
}
