import { describe, expect, it } from 'vitest';
import { cause_of, need_of, waiting_arms } from '../src/recovery/needs';
import type { Arm, Job } from '../src/server/messages';
import type { Notice } from '../src/state/notices';
import { arm_json, job_json, wait_json } from './samples';

const arm = (over: object) => arm_json('left', over) as Arm;
const notice = (over: Partial<Notice>): Notice => ({ key: 1, stream: 's', seq: 1, at: null, t_s: 1, level: 'warning', source: 'alert', text: '', arms: [], ...over });

describe('Recovery', () => {
  it('names the last cause of a stop', () => {
    const job = notice({ text: 'job a failed: overrun' });
    const stop = notice({ text: 'stopped: left, right (operator)' });
    const near = notice({ source: 'monitor', level: 'error', text: 'a and b 4 mm apart; stopped left' });
    expect(cause_of([job, stop, near])).toBe(stop);
    expect(cause_of([near, stop])).toBe(near);
    expect(cause_of([job])).toBeNull();
  });

  const pose = (a: number, b: number) => ({ left_panda_joint1: a, left_panda_joint2: b });

  it('lists an arm that has a fault but no job', () => {
    const listed = (state: string) => waiting_arms({ arms: new Map([['left', arm({ state, job: null })]]), job_of: () => null }).map(({ name }) => name);
    expect([listed('fault'), listed('idle')]).toEqual([['left'], []]);
  });

  it('describes what each arm needs by its state', () => {
    const job = job_json('pick', { name: 'pick 7', progress: 0.4 }) as Job;
    expect(need_of(arm({ state: 'stopped' }), job, pose(0, -1.2))).toMatchObject({ resume: true, home: false, words: expect.stringMatching(/pick 7.*40 %/) });
    const stopped = job_json('pick', { waits_on: [wait_json({ kind: 'stop', id: null, arm: 'left', links: [] })] }) as Job;
    const waiting = (state: string) => waiting_arms({ arms: new Map([['left', arm({ state, job: 'pick' })]]), job_of: () => stopped }).map(({ name }) => name);
    expect(waiting('stopped')).toEqual(['left']);
    expect(waiting('moving')).toEqual(['left']);  // the arm is braking
    const next = job_json('place', { name: 'place 3' }) as Job;
    expect(need_of(arm({ state: 'stopped' }), null, pose(0, -1.2), next).words).toMatch(/^Resume: place 3 starts as soon as/);
    expect(need_of(arm({ state: 'stopped' }), job, pose(0, -1.2), next).words).toMatch(/^Resume: pick 7 continues/);
    expect(need_of(arm({ state: 'stopped' }), null, pose(0, -1.2)).words).toMatch(/none is waiting for it/);
    expect(need_of(arm({ state: 'fault' }), null, pose(0, -1.2))).toMatchObject({ resume: true });
    expect(need_of(arm({ state: 'idle' }), null, pose(0.5, -1.2))).toMatchObject({ resume: false, home: true });
    expect(need_of(arm({ state: 'idle' }), null, pose(0, -1.2))).toMatchObject({ resume: false, home: false });
    expect(need_of(arm({ state: 'idle' }), null, null)).toMatchObject({ resume: false, home: false, words: expect.stringMatching(/not known/) });
    expect(need_of(arm({ state: 'paused' }), job, pose(0, 0)).words).toMatch(/pick 7/);
  });
});
