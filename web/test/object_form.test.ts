import { describe, expect, it } from 'vitest';
import { blank_form, edits_since, fault_of_name, form_of, object_of, with_edits } from '../src/scene/object_form';
import type { SceneObject } from '../src/server/messages';

const kCan: SceneObject = { name: 'can', cylinder: [0.08, 0.3], xyz: [0.3, 0.9, 0.4], rpy: [Math.PI / 2, 0, 0] };

describe('Object form', () => {
  it('returns the object from which it was filled', () => {
    expect(object_of(form_of(kCan))).toEqual(kCan);
  });

  it('accepts the names that the server accepts, and explains others', () => {
    for (const name of ['rod', 'a b', '<b>crate', '拾う', '...', '😀'.repeat(64), 'x'.repeat(128)]) expect(fault_of_name(name)).toBe(null);
    expect(fault_of_name('a/b')).toMatch(/found \/$/);
    expect(fault_of_name('a\\b')).toMatch(/found \\$/);
    expect(fault_of_name('a\u0007b')).toMatch(/found a control character$/);
    expect(fault_of_name('..')).toMatch(/not a valid name/);
    expect(fault_of_name('..')).toMatch(/not a valid name/);
    expect(fault_of_name('x'.repeat(129))).toMatch(/128/);
    expect(object_of({ ...form_of(kCan), name: 'a/b' })).toHaveProperty('fault');
  });

  it('keeps typed input while the object changes, and follows it otherwise', () => {
    const form = with_edits(form_of({ ...kCan, xyz: [0.35, 0.9, 0.4] }), { values: { length: '-1' } });
    expect(form.values).toMatchObject({ length: '-1', x: '0.35', radius: '0.08' });
    expect(form.name).toBe('can');
  });

  it('keeps what the user typed while earlier input was being saved', () => {
    const sent = with_edits(blank_form(), { name: 'can ', kind: 'sphere', values: { x: '0.3', y: '1' } });
    expect(edits_since(sent, { name: 'can', kind: 'sphere', values: { x: '0.3', y: '2' } })).toEqual({ values: { y: '2' } });
    expect(edits_since(sent, { kind: 'box' })).toEqual({ kind: 'box', values: {} });
  });

  it('names the field that is not a number', () => {
    expect(object_of(with_edits(form_of(kCan), { values: { x: 'wide' } }))).toEqual({ fault: 'x: "wide" is not a number' });
    expect(object_of(with_edits(form_of(kCan), { values: { x: '0,15', y: ' ' } }))).toEqual({ fault: 'x: "0,15" is not a number: use a decimal point; y: "" is not a number' });
  });
});
