import { describe, expect, it } from 'vitest';
import { Api } from '../src/server/api';
import { ahead_of } from '../src/diagram/ahead';
import { OneAtATime } from '../src/diagram/one_at_a_time';
import { evidence_in_words, evidence_of, kept_in_words, plan_from, plan_in_words, shares, type Point } from '../src/diagram/reading';
import { parse_diagram, parse_job, type Diagram, type DiagramContact, type Job } from '../src/server/messages';
import { diagram_json, job_json, wait_json } from './samples';

type Cells = Parameters<typeof diagram_json>[0];

// The jobs conflict where left is past 2 s and right is past 1 s. The cell before this corner is
// undecided.
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

describe('Diagram', () => {
  it('is read with its cells', () => {
    expect(layer().cells?.[2]).toEqual({ state: 'undecided', a_s: [2, 4], b_s: [0.5, 1] });
    expect(diagram().a).toMatchObject({ id: 'left', duration_s: 4, progress_s: 1 });
  });
  it('is refused with the place of a fault', () => {
    const wrong = parse_diagram(diagram_json([['perhaps', 0, 1, 0, 1]]));
    expect(!wrong.ok && wrong.fault).toMatch(/^\/layers\/0\/cells\/0\/state: .*"free"/);
    const bent = parse_diagram(diagram_json([], { layers: [{ arms: ['left', 'right'], first_contact: null, cells: [{ state: 'free', a_s: [1], b_s: [0, 1] }] }] }));
    expect(!bent.ok && bent.fault).toMatch(/^\/layers\/0\/cells\/0\/a_s: .*too few items/);
  });
  it('is requested by two ids with any characters', async () => {
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
  it('has area shares that add up to one', () => {
    const { free, conflict, undecided } = shares(layer());
    expect(free).toBeCloseTo(7 / 12);
    expect(conflict).toBeCloseTo(4 / 12);
    expect(undecided).toBeCloseTo(1 / 12);
  });
});

describe('Diagram prediction', () => {
  it('advances both jobs equally, then follows the border', () => {
    expect(plan_from({ a_s: 1, b_s: 0.5 }, diagram())).toEqual([{ a_s: 1, b_s: 0.5 }, { a_s: 3.5, b_s: 3 }, { a_s: 4, b_s: 3 }]);
    expect(plan_from({ a_s: 4, b_s: 0 }, diagram())).toEqual([{ a_s: 4, b_s: 0 }, { a_s: 4, b_s: 0 }, { a_s: 4, b_s: 3 }]);
  });
  it('is no alarm while one job lacks authority, nor at the border of a conflict', () => {
    const contact: DiagramContact = { state: 'conflict', in_s: 1, a_s: 2, b_s: 2 };
    const ahead = (now: Point, authority: Point | null) => ahead_of(contact, now, authority, diagram())?.kind;
    expect(ahead({ a_s: 1, b_s: 1 }, { a_s: 4, b_s: 1 })).toBe('waits');
    expect(ahead({ a_s: 1, b_s: 1 }, { a_s: 2, b_s: 3 })).toBe('waits');
    expect(ahead({ a_s: 2, b_s: 2 }, { a_s: 2, b_s: 3 })).toBe('waits');  // left rests where it waits for right
    expect(ahead({ a_s: 2.01, b_s: 2 }, { a_s: 2.01, b_s: 3 })).toBe('waits');
    expect(ahead({ a_s: 1, b_s: 1 }, null)).toBe('waits');
    expect(ahead({ a_s: 1, b_s: 1 }, { a_s: 4, b_s: 3 })).toBe('allowed');
    expect(ahead_of(null, { a_s: 1, b_s: 1 }, null, diagram())).toEqual({ kind: 'free' });
    // At the end of a job, authority up to its end is enough: nothing lies beyond.
    expect(ahead_of({ ...contact, a_s: 4 }, { a_s: 4, b_s: 0 }, { a_s: 4, b_s: 3 }, diagram())?.kind).toBe('allowed');
  });
  it('states the remaining time, and nothing once the contact has passed', () => {
    const contact: DiagramContact = { state: 'undecided', in_s: 0.5, a_s: 2, b_s: 1.5 };
    expect(ahead_of(contact, { a_s: 1.75, b_s: 1.25 }, null, diagram())).toMatchObject({ contact: { in_s: 0.25 } });
    expect(ahead_of(contact, { a_s: 2.1, b_s: 1.6 }, null, diagram())).toBeNull();
  });
  it('is described, as an alarm only if nothing makes a job wait', () => {
    const conflict: DiagramContact = { state: 'conflict', in_s: 2, a_s: 2, b_s: 2 };
    const undecided: DiagramContact = { state: 'undecided', in_s: 0.25, a_s: 2, b_s: 0.75 };
    expect(plan_in_words({ kind: 'waits', contact: conflict }, 'right')).toEqual({ tone: 'calm', words: 'If right started now, they would reach a conflict in 2.00 s. One of the jobs has no authority to go that far and waits before it.' });
    expect(plan_in_words({ kind: 'waits', contact: undecided }, null)).toMatchObject({ tone: 'calm', words: expect.stringMatching(/^If both continued from here, they would reach an area that is not certified free in 0.25 s\./) as unknown });
    expect(plan_in_words({ kind: 'allowed', contact: undecided }, null).tone).toBe('calm');
    expect(plan_in_words({ kind: 'allowed', contact: conflict }, null)).toMatchObject({ tone: 'alarm', words: expect.stringMatching(/Nothing makes one of the jobs wait/) as unknown });
    expect(plan_in_words({ kind: 'free' }, null, 'left').words).toBe('While left rests at its end, the path of the other job is free.');
    expect(plan_in_words({ kind: 'free' }, null)).toMatchObject({ tone: 'free', words: expect.stringMatching(/without a conflict/) as unknown });
  });
});

describe('Diagram that is still being computed', () => {
  it('leaves the last diagram visible, with its time', () => {
    const jobs = [job('left', { state: 'succeeded', ended_s: 73.2 }), job('right')];
    expect(kept_in_words(diagram(), jobs, { a: 'next', b: 'right' })).toBe('As of 0:01:13.2: left and right. next and right are being drawn…');
    expect(kept_in_words(diagram(), [null, null], null)).toBe('Earlier diagram: left and right.');
  });
  it('is requested one at a time; the last request follows', async () => {
    const asked: [string, (answer: string) => void][] = [];
    const told: string[] = [];
    const drawings = new OneAtATime<string, string>((question) => new Promise((done) => { asked.push([question, done]); }), (answer, question) => told.push(`${question}: ${answer}`));
    for (const question of ['a', 'b', 'c']) drawings.want(question);
    expect(asked.map(([question]) => question)).toEqual(['a']);
    asked[0]?.[1]('drawn');
    await Promise.resolve();
    await Promise.resolve();
    expect([told, asked.map(([question]) => question)]).toEqual([['a: drawn'], ['a', 'c']]);
    drawings.close();
    asked[1]?.[1]('late');
    await Promise.resolve();
    await Promise.resolve();
    expect(told).toHaveLength(1);
  });
});

describe('Evidence in a diagram', () => {
  const waits = [wait_json({ id: 'left', arm: 'left', own_time_s: 2.5, other_time_s: 3.1 })];

  it('has the times of both jobs, whichever waits', () => {
    expect(evidence_of(job('left'), job('right', { waits_on: waits }))).toMatchObject({ a_s: 3.1, b_s: 2.5 });
    expect(evidence_of(job('right', { waits_on: waits }), job('left'))).toMatchObject({ a_s: 2.5, b_s: 3.1 });
  });
  it('is null if neither job waits for the other', () => {
    expect(evidence_of(job('left'), job('right', { waits_on: [wait_json({ id: 'third' })] }))).toBeNull();
    expect(evidence_of(null, job('right', { waits_on: waits }))).toBeNull();
  });
  it('names links, distance and both times', () => {
    const evidence = evidence_of(job('left'), job('right', { waits_on: waits }));
    expect(evidence && evidence_in_words(evidence, diagram())).toBe(
      'left_panda_hand would come within 12 mm of right_panda_link6, 3.10 s into left and 2.50 s into right.');
  });
});
