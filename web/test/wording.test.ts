import { describe, expect, it } from 'vitest';
import { parse_message, type Job, type MonitorData, type WaitsOn } from '../src/server/messages';
import {
  bytes_in_words, clearance_in_words, clock, conflict_in_words, figure_in_words, found_in_words, millimeters, monitor_in_words, reason_in_words,
  result_in_words, seconds, short_id, path_in_words, promises_in_words, why_not_connected,
} from '../src/wording';
import { controller, envelope, job_json, wait_json } from './samples';

function job(over: object): Job {
  const parsed = parse_message(envelope('job', 1, job_json('pick-7', over)));
  if (parsed.kind !== 'message' || parsed.message.type !== 'job') throw new Error(JSON.stringify(parsed));
  return parsed.message.data;
}

function reason(...waits: (object & Partial<WaitsOn>)[]): string {
  return reason_in_words(job({ state: 'backlogged', waits_on: waits.map(wait_json) }));
}

const kBare: Partial<WaitsOn> = { links: [], own_time_s: null, clearance_m: null };

describe('Reason to wait', () => {
  it('names the other job, the links, distance and time', () => {
    expect(reason({})).toBe(
      'waits for job place-6 of right: left_panda_hand would come within 12 mm of right_panda_link6, 1.24 s into its motion');
  });
  it('says touch without a clearance', () => {
    expect(reason({ clearance_m: -0.004 })).toContain('left_panda_hand would touch right_panda_link6, 1.24 s into its motion');
  });
  it('omits what the server does not state', () => {
    expect(reason(kBare)).toBe('waits for job place-6 of right to end');
    expect(reason({ ...kBare, id: 'job-6' })).toBe('waits for job-6 of right to end');
  });
  it('distinguishes a resting arm, an object, a predecessor, capacity and a stop', () => {
    expect(reason({ kind: 'arm', id: null })).toMatch(/^waits for arm right to move away: left_panda_hand would/);
    expect(reason({ kind: 'object', id: 'crate', arm: null, ...kBare })).toBe('waits until crate is out of the way');
    expect(reason({ kind: 'predecessor', id: 'pick-6', arm: 'left', ...kBare })).toBe('waits its turn: pick-6 of left goes first');
    expect(reason({ kind: 'capacity', ...kBare })).toBe('waits until job place-6 of right has ended (one at a time)');
    expect(reason({ kind: 'object', id: null, arm: null, links: ['left_panda_hand', 'table'] })).toMatch(
      /^waits until table is out of the way: left_panda_hand would come within 12 mm of table/);
    expect(reason({ kind: 'stop', id: null, arm: 'left', ...kBare, detail: 'fault: overrun' })).toBe(
      'waits for resume: left is stopped (fault: overrun)');
    expect(reason({ kind: 'stop', id: null, arm: null, ...kBare })).toBe('waits for resume: the cell is stopped');
  });
  it('counts further reasons', () => {
    expect(reason(kBare, {}, {})).toBe('waits for job place-6 of right to end (and 2 more)');
  });
  it('is the deadlock cycle, if there is one', () => {
    expect(reason_in_words(job({ state: 'backlogged', waits_on: [wait_json()], cycle: ['a', 'b', 'c'] }))).toBe(
      'deadlock: a -> b -> c -> a');
  });
  it('is empty for a job that waits for nothing', () => {
    expect(reason_in_words(job({ state: 'running' }))).toBe('');
  });
});

describe('Result of a job', () => {
  it('does not repeat the state', () => {
    expect(result_in_words(job({ state: 'succeeded', result: { reason: 'completed', detail: '' } }))).toBe('');
    expect(result_in_words(job({ state: 'canceled', result: { reason: 'canceled_by_client', detail: 'braked at 61 %' } }))).toBe('braked at 61 %');
  });
  it('has reason and detail', () => {
    const result = { reason: 'backlog_timeout', detail: 'waited 60 s for place-6' };
    expect(result_in_words(job({ state: 'expired', result }))).toBe('backlog timeout: waited 60 s for place-6');
  });
});

describe('Figure of a job', () => {
  const figure = (over: object, progress = 0) => figure_in_words(job({ submitted_s: 1, ...over }), 2.4, progress).text;

  it('states the meaning of its seconds', () => {
    expect(figure({ state: 'running', started_s: 1, duration_s: 4 }, 0.85)).toBe('0.6 s left');
    expect(['queued', 'backlogged', 'scheduled'].map((state) => figure({ state }))).toEqual(Array(3).fill('waited 1.4 s'));
    expect(figure({ state: 'succeeded', started_s: 1, ended_s: 2.3 })).toBe('ran 1.3 s');
  });
  it('is the waiting time of a job that ended without a start', () => {
    expect(figure({ state: 'expired', ended_s: 2 })).toBe('waited 1.0 s');
  });
  it('is a word while no time is known', () => {
    expect(figure({ state: 'paused', started_s: 1 })).toBe('paused');
    expect(figure({ state: 'running', started_s: 1, stopping: true })).toBe('stopping');
  });
});

describe('Value found at a fault', () => {
  it('is shown as JSON, and empty if the server gives none', () => {
    expect([3.41, 'x', [0]].map(found_in_words)).toEqual(['found 3.41', 'found "x"', 'found [0]']);
    expect([-0.01700000021609758, [0.30000001192, 2], { x: 1e-7 }].map(found_in_words)).toEqual(['found -0.017', 'found [0.3,2]', 'found {"x":1e-7}']);
    expect(found_in_words('😀'.repeat(300))).toBe(`found "${'😀'.repeat(198)}…`);
    expect([undefined, null, ''].map(found_in_words)).toEqual(['', '', '']);
  });
});

describe('Clearance', () => {
  it('names the kinds of bodies', () => {
    const named = (arms: [string] | [string, string]) => clearance_in_words({ arms, m: 0.1, links: ['a', 'b'] });
    expect([named(['left', 'right']), named(['left'])]).toEqual(['arm to arm', 'arm to object']);
  });
});

describe('Buttons', () => {
  it('are disabled without a connection, with the reason', () => {
    expect(why_not_connected({ status: 'open' })).toBeNull();
    expect(why_not_connected({ status: 'connecting' })).toMatch(/not connected/i);
    expect(why_not_connected({ status: 'lost', attempt: 1, retry_in_ms: 250 })).toMatch(/lost/);
  });
});

describe('Monitor event', () => {
  it('names links, distance and stopped arms', () => {
    const event: MonitorData = { kind: 'clearance', text: 'a and b are close', arms: ['left', 'right'], links: ['a', 'b'], clearance_m: 0.0091, limit_m: 0.01, stopped: ['left', 'right'] };
    expect(monitor_in_words(event)).toBe('a and b 9.1 mm apart (limit 10 mm); stopped left and right');
  });
  it('gives the sentence of the server for a violated premise', () => {
    const event: MonitorData = { kind: 'deviation', text: 'left left its path: j1 by 0.0020 rad, limit 0.0010 rad', arms: ['left'], joint: 'j1', value: 0.002, limit: 0.001, stopped: ['left'] };
    expect(monitor_in_words(event)).toBe('left left its path: j1 by 0.0020 rad, limit 0.0010 rad; stopped left');
  });
});

describe('Promises of a controller', () => {
  const promises = (units: string, measured: Parameters<typeof promises_in_words>[2]) => Object.fromEntries(promises_in_words(controller({ type: 'remote', feedback_timeout_s: 0.2 }), units, measured));
  it('are shown with what was measured', () => {
    expect(promises('rad', { deviation_rad: 0.0003, deviation_max_rad: 0.0012 })).toEqual({
      'Type': 'in a process of its own', 'Tracking error': '0.3 of 1.0 mrad (most in this session: 1.2)',
      'Reaction to a command': 'within 20 ms', 'Reports': 'every 1 ms; the arm is stopped if none arrives for 200 ms',
    });
  });
  it('are shown alone if nothing is known of that time', () => {
    expect(promises('m', null)['Tracking error']).toBe('at most 1.0 mm');
    expect(promises('rad and m', null)['Tracking error']).toBe('at most 1.0 mrad and mm');
  });
});

describe('Formatted numbers', () => {
  it('have units and sensible digits', () => {
    expect([0.0004, 0.0123, 1.5].map(millimeters)).toEqual(['0.4 mm', '12 mm', '1.50 m']);
    expect([0, 999, 1000, 9949, 9960, 123_456, 999_600, 1.2e9, 23e9].map(bytes_in_words)).toEqual(['0 B', '999 B', '1.0 kB', '9.9 kB', '10 kB', '123 kB', '1.0 MB', '1.2 GB', '23 GB']);
    expect([1.234, 12.34, 59.97, 75, 3599.4, 3599.6, 33_100].map(seconds)).toEqual(['1.2 s', '12.3 s', '1 min 0 s', '1 min 15 s', '59 min 59 s', '1 h 0 min', '9 h 11 min']);
    expect([0, 3661.29].map(clock)).toEqual(['0:00:00.0', '1:01:01.2']);
  });
  it('cut generated ids and keep chosen ids', () => {
    expect(short_id('0b9f1c3a-1111-4222-8333-444455556666')).toBe('0b9f1c3a');
    expect(short_id('😀'.repeat(30))).toBe(`${'😀'.repeat(23)}…`);
    expect(short_id('pick-7')).toBe('pick-7');
  });
});

describe('Conflict of a checked job', () => {
  it('names the blocker, distance and time', () => {
    expect(conflict_in_words(wait_json({ kind: 'object', id: 'post' }) as never)).toBe(
      'against post: left_panda_hand would come within 12 mm of right_panda_link6, 1.24 s into its motion');
    expect(conflict_in_words(wait_json({ kind: 'arm', id: null, arm: 'left', links: [] }) as never)).toBe('against arm left');
  });
});

describe('Path choices of a job', () => {
  it('describe selection, detour and replans', () => {
    expect(path_in_words(job({}))).toEqual([]);
    expect(path_in_words(job({ choice: { candidates: ['left', 'right'], selected: 'right', time_saved_s: 1.2, detail: 'it arrives 1.20 s sooner than left' } })))
      .toEqual(['right was selected from left, right: it arrives 1.20 s sooner than left']);
    expect(path_in_words(job({ detour: { candidates_evaluated: 2, selected: true, time_saved_s: 3.04 } })))
      .toEqual(['takes a detour: 2 paths around the space of other jobs were evaluated; this path arrives 3.0 s sooner']);
    expect(path_in_words(job({ detour: { candidates_evaluated: 1, selected: false, time_saved_s: null } })))
      .toEqual(['1 path around the space of other jobs was evaluated; the shortest path is as good']);
    expect(path_in_words(job({ replan: { done: 2, planning: false, cause: 'timeout', refused: 'no way was found' } }))).toEqual([
      'replanned 2 times (last cause: backlog timeout)',
      'replanning failed (backlog timeout): no way was found',
    ]);
  });
});
