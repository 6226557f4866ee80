import { describe, expect, it } from 'vitest';
import { Archive } from '../src/history/archive';
import { loaded_in_words } from '../src/history/loaded';
import type { Answer } from '../src/server/api';
import type { Job, JobPage, Problem } from '../src/server/messages';
import { short_wall_time, wall_time } from '../src/wall_time';
import { job_json } from './samples';

const ended = (number: number) => job_json(`j${number}`, {
  state: 'succeeded', ended_s: number, ended_at: new Date(1.8e12 + 1000 * number).toISOString(), result: { reason: 'completed', detail: '' },
}) as Job;

/** Returns a server with `count` jobs. The newest job has the highest number. */
function server(count: number) {
  const asked: string[] = [];
  const api = {
    jobs: async (limit: number, cursor: string | null): Promise<Answer<JobPage>> => {
      asked.push(`${limit} ${cursor ?? 'newest'}`);
      const before = cursor === null ? count : Number(cursor);
      const jobs = Array.from({ length: Math.min(limit, before) }, (_, i) => ended(before - 1 - i));
      const last = before - jobs.length;
      return { ok: true, value: { jobs, next_cursor: last > 0 ? String(last) : null } };
    },
    job: async (id: string): Promise<Answer<Job>> => {
      asked.push(id);
      const number = Number(id.slice(1));
      return number < count ? { ok: true, value: ended(number) } : { ok: false, problem: { type: 'about:blank', title: 'No such job', status: 404 } as Problem };
    },
  };
  return { api, asked };
}

describe('Archive', () => {
  it('loads pages newest first and skips known jobs', async () => {
    const { api, asked } = server(10_000);
    const archive = new Archive(api, (id) => Number(id.slice(1)) >= 9_500);
    await archive.more();
    expect(asked).toEqual(['1000 newest']);
    expect(archive.jobs.map(({ id }) => id).slice(0, 2)).toEqual(['j9499', 'j9498']);
    expect(archive.jobs).toHaveLength(500);
    await archive.more();
    expect(archive.jobs).toHaveLength(1500);
    expect(archive.state).toBe('more');
  });

  it('skips pages that contain only known jobs', async () => {
    const { api, asked } = server(10_000);
    const archive = new Archive(api, (id) => Number(id.slice(1)) >= 7_500);
    await archive.more();
    expect(asked).toEqual(['1000 newest', '1000 9000', '1000 8000']);
    expect(archive.jobs).toHaveLength(500);
  });

  it('ends with the last page and sends one request at a time', async () => {
    const { api, asked } = server(150);
    const archive = new Archive(api, () => false);
    await Promise.all([archive.more(), archive.more()]);
    expect([archive.state, archive.jobs.length, asked.length]).toEqual(['all', 150, 1]);
    await archive.more();
    expect(asked).toHaveLength(1);
  });

  it('finds jobs by id, requesting each once', async () => {
    const { api, asked } = server(10);
    const archive = new Archive(api, () => false);
    await Promise.all([archive.find('j3'), archive.find('j3'), archive.find('j99')]);
    await archive.find('j99');
    expect(archive.get('j3')?.id).toBe('j3');
    expect(archive.get('j99')).toBeNull();
    expect(asked).toEqual(['j3', 'j99']);
  });

  it('starts again in a new session and drops late answers of the old one', async () => {
    const { api } = server(10);
    const archive = new Archive(api, () => false);
    const late = archive.more();
    archive.forget();
    await late;
    expect([archive.jobs.length, archive.state]).toEqual([0, 'more']);
  });

  it('loads again what a snapshot dropped, without losing jobs', async () => {
    const { api } = server(150);
    let told = 100;
    const archive = new Archive(api, (id) => Number(id.slice(1)) >= 150 - told);
    await archive.more();
    expect([archive.state, archive.jobs.length]).toEqual(['all', 50]);
    told = 20;
    archive.reopen();
    expect([archive.state, archive.jobs.length]).toEqual(['more', 50]);
    await archive.more();
    expect([archive.state, archive.jobs.length]).toEqual(['all', 130]);
  });

  it('says why jobs cannot be loaded', async () => {
    const problem = { type: 'about:blank', title: 'Busy', status: 503 } as Problem;
    const archive = new Archive({ jobs: async () => ({ ok: false, problem }), job: async () => ({ ok: false, problem }) }, () => false);
    await archive.more();
    expect([archive.fault, archive.state]).toEqual([problem, 'more']);
  });
});

describe('Description of the loaded jobs', () => {
  it('states the limit until all jobs are loaded', () => {
    expect(loaded_in_words({ received: 208, ended_from_s: 552, fetched: 0, is_all: false })).toMatch(/^Jobs that ended since 0:09:12.0 are loaded\. Earlier jobs are neither/);
    expect(loaded_in_words({ received: 1137, ended_from_s: null, fetched: 0, is_all: false })).toMatch(/^All jobs of this server session .* previous sessions are neither loaded nor filtered/);
    expect(loaded_in_words({ received: 208, ended_from_s: 552, fetched: 800, is_all: false })).toMatch(/^The last 1008 jobs are loaded/);
    expect(loaded_in_words({ received: 208, ended_from_s: 552, fetched: 932, is_all: true })).toBeNull();
  });
});

describe('Wall-clock time', () => {
  it('is unambiguous: year first, 24 hours, with UTC offset', () => {
    const at = new Date(2026, 10, 6, 15, 4, 5);
    expect(wall_time(at.toISOString())).toMatch(/^2026-11-06 15:04:05 (UTC|[+−]\d\d:\d\d)$/);
    expect(short_wall_time(at.toISOString(), at.getTime() + 60_000)).toBe('15:04:05');
    expect(short_wall_time(at.toISOString(), at.getTime() + 86_400_000)).toBe('2026-11-06 15:04:05');
    expect(wall_time('never')).toBe('never');
  });
});
