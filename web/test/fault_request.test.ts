import { describe, expect, it } from 'vitest';
import type { CellController, CellRobot } from '../src/server/messages';
import { fault_in_words, kKinds, may_last, request_of, simulated_arms, value_of } from '../src/frame/fault_request';
import { controller } from './samples';

describe('simulated_arms', () => {
  const robot = (name: string, type: CellController['type']): CellRobot => ({
    name, prefix: '', base: { xyz: [0, 0, 0], rpy: [0, 0, 0] }, urdf: '', srdf: '', meshes: {}, controller: controller({ type }),
    arms: [{ name, group: 'arm', joints: [], gripper_joints: [], home: [], named_states: {} }],
  });
  it('has the arms with simulated controllers, also in a cell with remote ones', () => {
    expect(simulated_arms({ robots: [robot('left', 'sim'), robot('middle', 'remote'), robot('right', 'sim')] })).toEqual(['left', 'right']);
    expect(simulated_arms({ robots: [robot('left', 'remote')] })).toEqual([]);
  });
});

describe('request_of', () => {
  it('has a value and a duration only if the kind has them', () => {
    expect(request_of('left', 'stall', '7', ' ')).toEqual({ arm: 'left', kind: 'stall' });
    expect(request_of('left', 'drift', '-0.2', '1.5')).toEqual({ arm: 'left', kind: 'drift', value: -0.2, for_s: 1.5 });
    expect(request_of('left', 'reject', '', '2')).toEqual({ arm: 'left', kind: 'reject' });
  });
  it('is null if a text is not a number', () => {
    expect(request_of('left', 'drift', '0,2', '')).toBeNull();
    expect(request_of('left', 'stall', '', 'x')).toBeNull();
  });
  it('is shown with its value if the kind has one', () => {
    const fault = { id: '1', arm: 'left', kind: 'noise', at_s: null, for_s: null, value: 0.01 } as const;
    expect(fault_in_words(fault)).toBe('noise of left: 0.01');
    expect(fault_in_words({ ...fault, kind: 'cut', value: 0 })).toBe('cut of left');
  });
  it('offers a usual value for each kind that has one', () => {
    expect(Object.keys(kKinds)).toHaveLength(18);
    expect(value_of('drift')?.usual).toBe(0.1);
    expect(value_of('cut')).toBeNull();
    expect(may_last('fault')).toBe(false);
  });
});
