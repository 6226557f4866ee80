import { describe, expect, it } from 'vitest';
import { only_in_turn } from '../src/compose/check_results';
import { is_yaml } from '../src/compose/new_job';
import type { WaitsOn } from '../src/server/messages';
import { wait_json } from './samples';

const wait = (kind: string) => wait_json({ kind }) as WaitsOn;

describe('Check result', () => {
  it('says that a job waits its turn if only predecessors block it', () => {
    expect(only_in_turn({ verdict: 'conflict', waits_on: [wait('predecessor'), wait('predecessor')] })).toBe(true);
    expect(only_in_turn({ verdict: 'conflict', waits_on: [wait('predecessor'), wait('job')] })).toBe(false);
    expect(only_in_turn({ verdict: 'conflict', waits_on: [] })).toBe(false);
    expect(only_in_turn({ verdict: 'undecided', waits_on: [wait('predecessor')] })).toBe(false);
  });
});

describe('Pasted text', () => {
  it('is recognized as YAML in the format of ROS tools', () => {
    expect(['joint_names:\n- a', '---\ntrajectory:', 'header:\n  stamp: 1'].map(is_yaml)).toEqual([true, true, true]);
    expect(['{"a": 1}', '[1]', '', 'hello', '"a: b"'].map(is_yaml)).toEqual(Array(5).fill(false));
  });
});
