import { describe, expect, it } from 'vitest';
import { check } from '../src/server/check';
import { arm_json, job_json, wait_json } from './samples';

const fault_of = (name: 'Arm' | 'Job', value: unknown) => {
  const checked = check(name, value);
  return checked.ok ? null : checked.fault;
};

describe('Validation', () => {
  it('accepts described messages, also with unknown members', () => {
    expect(fault_of('Arm', arm_json('left'))).toBeNull();
    expect(fault_of('Job', job_json('j', { of_a_newer_server: 7 }))).toBeNull();
  });

  it('names the place and the value found, however deep', () => {
    expect(fault_of('Arm', arm_json('left', { q: [0.1, 'far'] }))).toMatch(/^\/q\/1: .*Found "far"$/);
    expect(fault_of('Job', job_json('j', { waits_on: [wait_json(), wait_json({ clearance_m: 'wide' })] }))).toMatch(/^\/waits_on\/1\/clearance_m: .*Found "wide"$/);
  });

  it('names a missing member', () => {
    const { joints: _, ...without } = arm_json('left');
    expect(fault_of('Arm', without)).toMatch(/joints/);
  });

  it('cuts long values', () => {
    expect(fault_of('Arm', arm_json('left', { progress: 'x'.repeat(1_000_000) }))?.length).toBeLessThan(300);
  });

  it('refuses values that are not objects', () => {
    for (const value of [null, undefined, 7, 'arm', []]) expect(fault_of('Arm', value)).not.toBeNull();
  });
});
