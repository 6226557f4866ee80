import { describe, expect, it } from 'vitest';
import { pair_of, parse_cell, parse_message, parse_problem, range_of, shape_of, type Message } from '../src/server/messages';
import { arm_json, controller, envelope, frame, job_json, snapshot, wait_json } from './samples';

function good(text: string): Message {
  const parsed = parse_message(text);
  if (parsed.kind !== 'message') throw new Error(JSON.stringify(parsed));
  return parsed.message;
}

describe('Message', () => {
  it('is read completely if it is a snapshot', () => {
    const message = good(snapshot(7, { jobs: [job_json('a')], gap: true }));
    if (message.type !== 'snapshot') throw new Error(message.type);
    expect(message.seq).toBe(7);
    expect(message.data.gap).toBe(true);
    expect(message.data.arms.map((arm) => arm.name)).toEqual(['left', 'right']);
    expect(message.data.objects.map(shape_of)[0]).toEqual({ kind: 'box', size: [2, 2, 0.1] });
    expect(message.data.jobs[0]).toEqual(job_json('a'));
  });

  it('may be of every type in the contract', () => {
    const ids = { queued: ['a'], backlog: [], scheduled: [], running: [] };
    const texts = [
      envelope('job', 1, job_json('a', { state: 'backlogged', waits_on: [wait_json()] })),
      envelope('arm', 2, arm_json('left', { state: 'fault' })),
      envelope('queue', 3, { stopped: true, ...ids }),
      envelope('monitor', 4, { kind: 'contact', text: 'a and b touch', arms: ['left'], links: ['a', 'b'], clearance_m: 0, limit_m: 0.01, stopped: ['left'] }),
      envelope('alert', 5, { level: 'warning', text: 'x' }),
      envelope('scene', 6, { version: 2, objects: [{ name: 'rod', cylinder: [0.015, 0.5], xyz: [0, 0, 1], rpy: [0, 0, 0] }, { name: 'ball', sphere: [0.1], xyz: [0, 0, 0], rpy: [0, 0, 0] }] }),
      frame(7, { left_panda_joint1: 0.5 }),
    ];
    expect(texts.map((text) => good(text).type)).toEqual(['job', 'arm', 'queue', 'monitor', 'alert', 'scene', 'state']);
  });

  it('may have empty links and names, and clearances to the scene', () => {
    const job = good(envelope('job', 1, job_json('a', { name: '', waits_on: [wait_json({ kind: 'capacity', links: [] })] })));
    expect(job.type === 'job' && [job.data.name, pair_of(job.data.waits_on[0]?.links ?? ['x', 'y'])]).toEqual(['', null]);
    const near = { arms: ['left'], m: 0.05, links: ['left_panda_hand', 'table'] };
    const state = good(JSON.stringify({ type: 'state', t_s: 1, q: {}, clearance: [near], motions: [], speed: 1 }));
    expect(state.type === 'state' && state.clearance).toEqual([near]);
  });

  it('may have members unknown to this page', () => {
    expect(good(envelope('alert', 1, { level: 'info', text: 'x', since: 7 }, { to: 'all' })).type).toBe('alert');
  });

  it('of unknown type is returned with its stream and number', () => {
    expect(parse_message(envelope('weather', 9, {}))).toMatchObject({ kind: 'unknown', type: 'weather', seq: 9 });
  });

  it.each([
    ['{', /not JSON/],
    ['null', /^\/type: expected a string/],
    ['[]', /^\/type: expected a string/],
    ['{"type":7}', /^\/type: expected a string/],
    [envelope('job', 1, job_json('a', { state: 'flying' })), /^\/data\/state: .*"running".* Found "flying"/],
    [envelope('job', 1, job_json('a', { waits_on: [wait_json({ links: ['a', 'b', 'c'] })] })), /^\/data\/waits_on\/0\/links: .*too many items/],
    [envelope('arm', 1, arm_json('left', { q: [0, null] })), /^\/data\/q\/1: .*Expected "number".* Found null/],
    [envelope('alert', 1, { level: 'info' }), /^\/data: .*required property "text"/],
    [envelope('alert', 1, { level: 'info', text: 'x' }, { seq: 'one' }), /^\/seq/],
    [frame(1, { joint: 'x' as unknown as number }), /^\/q\/joint: .*Expected "number".* Found "x"/],
  ])('is refused with the place of the fault: %s', (text, fault) => {
    const parsed = parse_message(text);
    expect(parsed.kind).toBe('malformed');
    expect(parsed.kind === 'malformed' && parsed.fault).toMatch(fault);
  });

  it('reads no inherited property', () => {
    expect(parse_message('{"type":"toString"}')).toMatchObject({ kind: 'unknown' });
  });
});

describe('Cell', () => {
  const cell = {
    name: 'two_pandas', policy: 'sequential', speed: 1, simulated: true, self_clearance_m: 0.005,
    checking: { time_step_s: 0.05, tracking_error_rad: 0.001, delay_s: 0.1, limit_tolerance: 0.05 },
    scheduling: { policy: 'sequential', backlog_timeout_s: 60, aging_s: 30, horizon_steps: 6, on_restart: 'ask', on_idle_blocker: 'park' },
    monitor: { rate_hz: 100, reaction_s: 0.02, stop_clearance_m: 0.01 },
    execution: { start_tolerance_rad: 0.01, duration_scaling: 1.1, duration_margin_s: 0.5, velocity_scaling_factor: 1 },
    robots: [{
      name: 'left', prefix: 'left_', base: { xyz: [-0.4, 0, 0.1], rpy: [0, 0, 0] }, urdf: '<robot/>', srdf: '', meshes: {}, controller: controller(),
      arms: [{ name: 'left', group: 'panda_arm', joints: ['left_panda_joint1'], gripper_joints: [], home: [0], named_states: {} }],
    }],
    objects: [], joints: [{ name: 'left_panda_joint1', arm: 'left', lower: -2, upper: 2, velocity_max: 2, acceleration_max: 4, jerk_max: 9, brake: 8, unit: 'rad' }],
    clearance_m: 0.02,
  };

  it('is read with robots and joints', () => {
    const read = parse_cell(cell);
    expect(read.ok && read.value.robots[0]?.base.xyz).toEqual([-0.4, 0, 0.1]);
    expect(read.ok && read.value.joints.map(range_of)).toEqual([[-2, 2]]);
    const turning = parse_cell({ ...cell, joints: [{ ...cell.joints[0], lower: null, upper: null }] });
    expect(turning.ok && turning.value.joints.map(range_of)).toEqual([[-Infinity, Infinity]]);
  });

  it('has the addresses of the meshes of robots and objects', () => {
    const meshes = { 'package://p/a.stl': '/api/v1/cell/meshes/1.stl' };
    const objects = [{ name: 'part', mesh: '/api/v1/cell/meshes/2.obj', scale: [1, 1, -2], xyz: [1, 0, 0], rpy: [0, 0, 0] }];
    const read = parse_cell({ ...cell, objects, robots: [{ ...cell.robots[0], meshes }] });
    expect(read.ok && read.value.robots[0]?.meshes).toEqual(meshes);
    expect(read.ok && read.value.objects.map(shape_of)[0]).toEqual({ kind: 'mesh', address: '/api/v1/cell/meshes/2.obj', scale: [1, 1, -2] });
    const plain = parse_cell(cell);
    expect(plain.ok && plain.value.robots[0]?.meshes).toEqual({});
    const wrong = parse_cell({ ...cell, robots: [{ ...cell.robots[0], meshes: { a: 1 } }] });
    expect(!wrong.ok && wrong.fault).toMatch(/^\/robots\/0\/meshes\/a: .*Expected "string"/);
  });

  it('is refused with the place of the fault', () => {
    const read = parse_cell({ ...cell, robots: [{ ...cell.robots[0], base: { xyz: [1, 2], rpy: [0, 0, 0] } }] });
    expect(!read.ok && read.fault).toMatch(/^\/robots\/0\/base\/xyz: .*too few items/);
  });
});

describe('Problem document', () => {
  it('has every fault with pointer and value', () => {
    const fault = { pointer: '/trajectory/points/3/velocities/2', detail: '3.41 rad/s exceeds 2.175', value: 3.41 };
    const read = parse_problem({ type: 'urn:x', title: 'Limits', status: 422, ...fault, errors: [fault, { ...fault, value: 4 }] });
    expect(read.ok && read.value.errors?.map((e) => e.value)).toEqual([3.41, 4]);
    expect(read.ok && read.value.pointer).toBe(fault.pointer);
  });
});
