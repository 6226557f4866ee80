import { describe, expect, it } from 'vitest';
import { form_of_pose, numbers_in, plan_request, pose_of_form, states_of, type GoalForm } from '../src/compose/goal';
import type { CellArm } from '../src/server/messages';

const form = (over: Partial<GoalForm>): GoalForm => ({ arm: 'left', kind: 'named', named: 'ready', joints: '', xyz: '0, 0.2, 0.5', rpy: '180 0 0', link: '', speed: '50', ...over });
const body = (over: Partial<GoalForm>): unknown => {
  const asked = plan_request(form(over));
  return asked.ok ? JSON.parse(asked.text) : asked.fault;
};

describe('Goal form', () => {
  it('makes a request for a named state, joints, or a pose in degrees', () => {
    expect(body({})).toEqual({ arm: 'left', to: { named: 'ready' }, velocity_scaling_factor: 0.5 });
    expect(body({ kind: 'joints', joints: '[0, -1.2,0.5]' })).toMatchObject({ to: { joints: [0, -1.2, 0.5] } });
    expect(body({ kind: 'pose', link: ' left_hand ' })).toMatchObject({ to: { pose: { link: 'left_hand', xyz: [0, 0.2, 0.5], rpy: [Math.PI, 0, 0] } } });
    expect(body({ kind: 'pose' })).not.toHaveProperty('to.pose.link');
  });

  it('names the unreadable part and the value found', () => {
    expect(body({ kind: 'joints', joints: '1, two' })).toMatch(/Joints.*1, two/);
    expect(body({ kind: 'pose', xyz: '1 2' })).toMatch(/Position.*1 2/);
    expect(body({ kind: 'pose', rpy: '' })).toMatch(/Rotation/);
    expect(body({ speed: '0' })).toMatch(/Speed/);
  });

  it('takes a dragged pose, and returns the same pose', () => {
    const texts = form_of_pose({ xyz: [0.12345, -0.2, 0.5], rpy: [Math.PI, 0, -Math.PI / 4] });
    expect(texts).toEqual({ xyz: '0.123, -0.2, 0.5', rpy: '180, 0, -45' });
    expect(pose_of_form(texts)?.rpy[2]).toBeCloseTo(-Math.PI / 4);
    expect(pose_of_form({ xyz: '', rpy: '180, 0, 0' })).toBeNull();
  });

  it('lists home once among the named states', () => {
    expect(states_of(undefined)).toEqual(['home']);
    expect(states_of({ named_states: { ready: [], home: [] } } as unknown as CellArm)).toEqual(['home', 'ready']);
  });

  it('reads numbers separated by commas or blanks', () => {
    expect(numbers_in(' 1,  2\n-3e-1 ')).toEqual([1, 2, -0.3]);
    expect(numbers_in('')).toBeNull();
  });
});
