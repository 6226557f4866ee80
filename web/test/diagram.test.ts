import { describe, expect, it } from 'vitest';
import { Api } from '../src/server/api';
import { evidence_in_words, evidence_of, plan_from, plan_in_words, shares } from '../src/diagram/reading';
import { parse_diagram, parse_job, type Diagram, type Job } from '../src/server/messages';
import { diagram_json, job_json, wait_json } from './samples';

type Cells = Parameters<typeof diagram_json>[0];

// In conflict where left is past 2 s and right past 1 s; the corner before it is not decided.
const kCells: Cells = [
  ['free', 0, 2, 0, 3], ['free', 2, 4, 0, 0.5], ['undecided', 2, 4, 0.5, 1], ['conflict', 2, 4, 1, 3],
];

function diagram(cells = kCells): Diagram {
  const parsed = parse_diagram(diagram_json(cells));
  if (!parsed.ok) throw new Error(parsed.fault);
  return parsed.value;
}
function layer(cells?: Cells) {
  const [first] = diagram(cells).layers;
  if (!first) throw new Error('no layer');
  return first;
}
function job(id: string, over: object = {}): Job {
  const parsed = parse_job(job_json(id, over));
  if (!parsed.ok) throw new Error(parsed.fault);
  return parsed.value;
}

describe('a diagram', () => {
  it('is read with its cells', () => {
    expect(layer().cells?.[2]).toEqual({ state: 'undecided', a_s: [2, 4], b_s: [0.5, 1] });
    expect(diagram().a).toMatchObject({ id: 'left', duration_s: 4, progress_s: 1 });
  });
  it('is refused with the place of what is wrong in it', () => {
    const wrong = parse_diagram(diagram_json([['perhaps', 0, 1, 0, 1]]));
    expect(!wrong.ok && wrong.fault).toMatch(/^\/layers\/0\/cells\/0\/state: .*"free"/);
    const bent = parse_diagram(diagram_json([], { layers: [{ arms: ['left', 'right'], met: null, cells: [{ state: 'free', a_s: [1], b_s: [0, 1] }] }] }));
    expect(!bent.ok && bent.fault).toMatch(/^\/layers\/0\/cells\/0\/a_s: .*too few items/);
  });
  it('is asked for by both ids, whatever characters they hold', async () => {
    let asked = '';
    const api = new Api('/api/v1', (url) => {
      asked = url;
      return Promise.resolve(new Response(JSON.stringify(diagram_json(kCells))));
    });
    const answer = await api.diagram('a/1', 'b&2');
    expect(asked).toBe('/api/v1/jobs/a%2F1/diagram?with=b%262');
    expect(answer.ok && answer.value.layers[0]?.cells).toHaveLength(4);
    await api.diagram('a/1', 'b&2', false);
    expect(asked).toBe('/api/v1/jobs/a%2F1/diagram?with=b%262&cells=0');
  });
  it('has shares of its area that add up to one', () => {
    const { free, conflict, undecided } = shares(layer());
    expect(free).toBeCloseTo(7 / 12);
    expect(conflict).toBeCloseTo(4 / 12);
    expect(undecided).toBeCloseTo(1 / 12);
  });
});

describe('the plan', () => {
  it('goes on for both alike, then along the border', () => {
    expect(plan_from({ a_s: 1, b_s: 0.5 }, diagram())).toEqual([{ a_s: 1, b_s: 0.5 }, { a_s: 3.5, b_s: 3 }, { a_s: 4, b_s: 3 }]);
    expect(plan_from({ a_s: 4, b_s: 0 }, diagram())).toEqual([{ a_s: 4, b_s: 0 }, { a_s: 4, b_s: 0 }, { a_s: 4, b_s: 3 }]);
  });
  it('is put into words', () => {
    expect(plan_in_words({ state: 'conflict', in_s: 2, a_s: 2, b_s: 2 }, 'right')).toBe('If right started now, they meet a conflict in 2.00 s.');
    expect(plan_in_words({ state: 'undecided', in_s: 0.25, a_s: 2, b_s: 0.75 }, null)).toBe('If both go on from here, they meet what is not proven free in 0.25 s.');
    expect(plan_in_words(null, null, 'left')).toBe('While left rests at its end, the way of the other one is free.');
    expect(plan_in_words(null, null)).toMatch(/through free cells only/);
  });
});

describe('the evidence', () => {
  const waits = [wait_json({ id: 'left', arm: 'left', own_time_s: 2.5, other_time_s: 3.1 })];

  it('lies at the times of both, whichever of them waits', () => {
    expect(evidence_of(job('left'), job('right', { waits_on: waits }))).toMatchObject({ a_s: 3.1, b_s: 2.5 });
    expect(evidence_of(job('right', { waits_on: waits }), job('left'))).toMatchObject({ a_s: 2.5, b_s: 3.1 });
  });
  it('is none when neither waits for the other', () => {
    expect(evidence_of(job('left'), job('right', { waits_on: [wait_json({ id: 'third' })] }))).toBeNull();
    expect(evidence_of(null, job('right', { waits_on: waits }))).toBeNull();
  });
  it('names links, distance and both times', () => {
    const evidence = evidence_of(job('left'), job('right', { waits_on: waits }));
    expect(evidence && evidence_in_words(evidence, diagram())).toBe(
      'left_panda_hand would come within 12 mm of right_panda_link6, 3.10 s into left and 2.50 s into right.');
  });
});
