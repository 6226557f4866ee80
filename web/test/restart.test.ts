import { describe, expect, it } from 'vitest';
import { parse_message } from '../src/server/messages';
import { Store } from '../src/state/store';
import { restart_in_words } from '../src/wording';
import { envelope, job_json, snapshot } from './samples';

describe('Server restart', () => {
  it('is reported with the jobs of unknown status', () => {
    const store = new Store(() => 0);
    const take = (...texts: string[]) => texts.forEach((text) => {
      const parsed = parse_message(text);
      if (parsed.kind !== 'message') throw new Error(JSON.stringify(parsed));
      store.take(parsed.message);
    });
    take(snapshot(1), envelope('job', 2, job_json('ran', { state: 'running' })), envelope('job', 3, job_json('kept')), envelope('job', 4, job_json('over', { state: 'succeeded', ended_s: 3 })));
    expect(store.restart).toBeNull();
    take(snapshot(1, { jobs: [job_json('kept')] }, { stream: '5f0c7f0e-6f0e-4d55-9b1c-0d3a54c7a002' }));
    expect([store.restart?.at, store.restart?.lost.map(({ id }) => id)]).toEqual(['2026-01-01T00:00:00Z', ['ran']]);
    expect(restart_in_words(store.restart ?? { lost: [] }, '14:02:11')).toMatch(/restarted; .* since 14:02:11\. Status unknown for 1 job: ran; /);
    store.dismiss_restart();
    expect(store.restart).toBeNull();
  });
});
