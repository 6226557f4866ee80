import { describe, expect, it } from 'vitest';
import { Api } from '../src/server/api';
import { job_json } from './samples';

function api_that_answers(status: number, body: string) {
  const asked: { url: string; init: RequestInit | undefined }[] = [];
  const api = new Api('/api/v1', (url, init) => {
    asked.push({ url, init });
    return Promise.resolve(new Response(body, { status, statusText: 'said' }));
  });
  return { api, asked };
}

describe('Api', () => {
  it('posts the text unchanged', async () => {
    const { api, asked } = api_that_answers(202, '{"id":"j-1"}');
    expect(await api.post_job('{not json')).toEqual({ ok: true, value: { id: 'j-1' } });
    expect(asked[0]?.url).toBe('/api/v1/jobs');
    expect(asked[0]?.init).toMatchObject({ method: 'POST', body: '{not json', headers: { 'content-type': 'application/json' } });
  });

  it('fetches recordings and returns the addresses of their files', async () => {
    const list = { kept: true, recordings: [{ name: 'data', begun_at: null, written_at: '', running: true, has_states: false, files: [{ name: 'events.jsonl', bytes: 3 }] }] };
    const { api, asked } = api_that_answers(200, JSON.stringify(list));
    expect(await api.recordings()).toEqual({ ok: true, value: list });
    expect(asked[0]?.url).toBe('/api/v1/recordings');
    expect(api.recording_address('a/b', 'c d')).toBe('/api/v1/recordings/a%2Fb/c%20d');
    const wrong = await api_that_answers(200, '{"kept": true}').api.recordings();
    expect(wrong.ok ? '' : wrong.problem.title).toBe('The list of recordings cannot be read');
  });

  it('cancels by id with any characters', async () => {
    const { api, asked } = api_that_answers(202, '');
    expect((await api.cancel_job('a/b?c')).ok).toBe(true);
    expect(asked[0]?.url).toBe('/api/v1/jobs/a%2Fb%3Fc');
  });

  it('changes the given members of a job', async () => {
    const { api, asked } = api_that_answers(200, '{"id":"a"}');
    expect((await api.amend_job('a/b', { priority: 3 })).ok).toBe(true);
    expect(asked[0]).toMatchObject({ url: '/api/v1/jobs/a%2Fb', init: { method: 'PATCH', body: '{"priority":3}' } });
  });

  it('requests replans, trajectories and plans', async () => {
    const { api, asked } = api_that_answers(200, JSON.stringify({ id: 'a', duration_s: 2, trajectory: { joint_names: ['x'], points: [{ positions: [0] }] } }));
    expect((await api.replan_job('a/b')).ok).toBe(true);
    expect(asked[0]).toMatchObject({ url: '/api/v1/jobs/a%2Fb/replan', init: { method: 'POST' } });
    expect(await api.job_motion('a/b')).toMatchObject({ ok: true, value: { duration_s: 2 } });
    expect(asked[1]?.url).toBe('/api/v1/jobs/a%2Fb/trajectory');
    const unread = await api.plan('{"arm": "left"}');
    expect(asked[2]).toMatchObject({ url: '/api/v1/plan', init: { method: 'POST', body: '{"arm": "left"}' } });
    expect(unread.ok ? '' : unread.problem.title).toBe('The plan cannot be read');
  });

  it('validates a fetched job', async () => {
    const { api, asked } = api_that_answers(200, JSON.stringify(job_json('a/1', { state: 'running', progress: 0.4 })));
    const answer = await api.job('a/1');
    expect(asked[0]?.url).toBe('/api/v1/jobs/a%2F1');
    expect(answer.ok && answer.value.progress).toBe(0.4);
    const wrong = await api_that_answers(200, JSON.stringify(job_json('a', { state: 'flying' }))).api.job('a');
    expect(!wrong.ok && wrong.problem.detail).toMatch(/^\/state: .*"running"/);
  });

  it('returns a problem document with its place and value', async () => {
    const problem = { type: 'urn:armloom:problem:limits', title: 'Limits', status: 422, detail: 'too fast', pointer: '/trajectory/points/3', value: 3.41 };
    const answer = await api_that_answers(422, JSON.stringify(problem)).api.post_job('{}');
    expect(!answer.ok && answer.problem).toMatchObject(problem);
  });

  it('shows an answer that is not a problem document unchanged', async () => {
    const answer = await api_that_answers(502, 'bad gateway').api.stop();
    expect(!answer.ok && answer.problem).toMatchObject({ title: 'said', status: 502, detail: 'bad gateway' });
  });

  it('returns a problem if the server does not answer', async () => {
    const api = new Api('', () => Promise.reject(new Error('refused')));
    const answer = await api.resume();
    expect(!answer.ok && answer.problem.detail).toContain('refused');
  });

  it('says where a cell is invalid', async () => {
    const answer = await api_that_answers(200, '{"name":"c","policy":"p","robots":{}}').api.cell();
    expect(!answer.ok && answer.problem.detail).toMatch(/^\/robots: .*Expected "array"/);
  });
});
