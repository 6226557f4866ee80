import { describe, expect, it } from 'vitest';
import type { Answer, Api } from '../src/server/api';
import { Actions } from '../src/state/actions';
import type { Store } from '../src/state/store';

function asked(answer: Answer<unknown>): Actions {
  const api = { stop: () => Promise.resolve(answer) } as unknown as Api;
  return new Actions(api, { set_stopped: () => undefined } as unknown as Store, {} as never, () => undefined);
}

const problem = { type: 'about:blank', title: 'Conflict', status: 409, detail: 'somebody else holds control' };

describe('Actions', () => {
  it('shows a refusal of the server', async () => {
    const actions = asked({ ok: false, problem });
    await actions.stop();
    expect(actions.refusal.value).toBe('Stop all was refused: somebody else holds control');
  });
  it('warns that arms may still move if the server does not answer', async () => {
    const actions = asked({ ok: false, problem: { ...problem, title: 'The server does not answer', status: 0, detail: 'TypeError: Failed to fetch' } });
    await actions.stop();
    expect(actions.refusal.value).toMatch(/^Stop all was not answered at \d\d:\d\d:\d\d: .*arms may still move/);
    expect(actions.stopping.value).toBe(false);
  });
});
