import { describe, expect, it } from 'vitest';
import { composed, type Composed } from '../src/compose/composed';
import { kBodyMax_bytes, read_job_file } from '../src/compose/job_file';
import { composed_in_worker, kLong, type WorkerLike } from '../src/compose/long_text';
import { motion_of_parts } from '../src/motion/pasted';
import { read_mcap } from '../src/recordings/read_mcap';

const file = (name: string, text: string) => new File([text], name);
const trajectory = (points: number) => ({ joint_names: ['j1'], points: Array.from({ length: points }, (_, i) => ({ time_from_start: i, positions: [i] })) });

describe('Job file', () => {
  it('is not read if it is too large for the server', async () => {
    let reads = 0;
    const huge = { name: 'huge.json', size: 20_000_000, text: () => { reads += 1; return Promise.resolve('{}'); } };
    expect(await read_job_file(huge)).toEqual({ ok: false, fault: 'huge.json has 20 MB; the server accepts at most 8.4 MB (8 MiB) in one request. It was not read.' });
    expect(reads).toBe(0);
    expect(await read_job_file({ ...huge, size: kBodyMax_bytes })).toEqual({ ok: true, text: '{}' });
  });

  it('without JSON is refused with its name', async () => {
    for (const [text, words] of [['', 'is empty'], ['joint_names:\n- j1', /YAML|it begins with "joint_names:"/], ['{"a": ', 'is not valid JSON: ']] as const) {
      const read = await read_job_file(file('x.json', text));
      expect(read, text).toMatchObject({ ok: false, fault: expect.stringMatching(words) as unknown });
      expect(read.ok ? '' : read.fault).toContain('x.json ');
    }
  });

  it('is read in a worker if it is long', async () => {
    const text = JSON.stringify({ id: 'x'.repeat(kLong), trajectory: trajectory(1) });
    const beside: number[] = [];
    const read = (text: string): Promise<Composed> => { beside.push(text.length); return Promise.resolve(composed(text)); };
    expect(await read_job_file(file('long.json', text), read)).toEqual({ ok: true, text });
    expect(await read_job_file(file('short.json', '{}'), read)).toEqual({ ok: true, text: '{}' });
    expect(beside).toEqual([text.length]);
  });
});

describe('Job text', () => {
  it('is prepared for checking, sending and preview', async () => {
    const one = composed(JSON.stringify(trajectory(2)));
    expect(one).toMatchObject({ kind: 'one', fault: null, request: { path: '/jobs' }, parts: [{ begins_s: 0 }] });
    expect([await one.request.body.text(), await one.bodies[0]?.body.text()]).toEqual([JSON.stringify({ trajectory: trajectory(2) }), JSON.stringify({ trajectory: trajectory(2) })]);
    const batch = composed(JSON.stringify([{ trajectory: trajectory(3) }, { trajectory: trajectory(2) }]));
    expect(await batch.request.body.text()).toBe(JSON.stringify({ atomic: true, jobs: [{ trajectory: trajectory(3) }, { trajectory: trajectory(2) }] }));
    expect(await batch.bodies[1]?.body.text()).toBe(JSON.stringify({ trajectory: trajectory(2) }));
    expect([batch.kind, batch.request.path, batch.bodies.length, batch.parts.map(({ begins_s }) => begins_s)]).toEqual(['batch', '/batches', 2, [0, 2]]);
  });

  it('is previewed with a limited number of points, including the first and last', () => {
    const points = (n: number) => composed(JSON.stringify(trajectory(n))).parts[0]?.piece.points.map(({ t_s }) => t_s) ?? [];
    expect(points(10_000)).toHaveLength(10_000);
    expect(points(10_002).length).toBe(5_002);
    expect([points(10_002)[1], points(10_002).at(-1)]).toEqual([2, 10_001]);
    expect(points(50_000).length).toBeLessThanOrEqual(10_001);
    expect(composed('[]').parts).toEqual([]);
    expect(motion_of_parts(composed(JSON.stringify(trajectory(30_000))).parts)?.q_at(14_999.5)).toEqual({ j1: 14_999.5 });
  });

  it('is canceled together with its worker', async () => {
    const workers: (WorkerLike & { ended: number; got: string[] })[] = [];
    const make = () => {
      const worker = { ended: 0, got: [] as string[], onmessage: null, onerror: null, postMessage: (text: string) => void worker.got.push(text), terminate: () => { worker.ended += 1; } };
      workers.push(worker);
      return worker as WorkerLike;
    };
    const stop = new AbortController();
    const given_up = composed_in_worker('{}', stop.signal, make);
    stop.abort();
    await expect(given_up).rejects.toThrow('canceled');
    const done = composed_in_worker('[1]', new AbortController().signal, make);
    workers[1]?.onmessage?.({ data: composed('[1]') } as MessageEvent<Composed>);
    expect((await done).kind).toBe('batch');
    expect(workers.map(({ ended, got }) => [ended, got])).toEqual([[1, ['{}']], [1, ['[1]']]]);
    expect(await composed_in_worker('[1]', new AbortController().signal, make)).toBe(await done);  // the text is not read twice
    expect(workers).toHaveLength(2);
  });

  it('is read by the page if no worker can run', async () => {
    const worker: WorkerLike = { onmessage: null, onerror: null, postMessage: () => worker.onerror?.({} as ErrorEvent), terminate: () => undefined };
    expect(await composed_in_worker('[2]', new AbortController().signal, () => worker)).toMatchObject({ kind: 'batch', fault: null });
  });
});

describe('MCAP file', () => {
  it('is recognized by its magic bytes', async () => {
    expect(await read_mcap(new Blob(['hello']))).toEqual({ ok: false, fault: 'The file is not MCAP: its first bytes differ from those of MCAP.' });
    expect(await read_mcap(new Blob([]))).toEqual({ ok: false, fault: 'The file is empty.' });
  });
});
