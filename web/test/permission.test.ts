import { signal } from '@preact/signals';
import { describe, expect, it } from 'vitest';
import type { Session } from '../src/server/messages';
import { why_no_command, why_not_permitted } from '../src/state/permission';
import { Store } from '../src/state/store';

describe('Commands', () => {
  const store = new Store();
  store.set_link({ status: 'open' });
  const why = (session: Session | null) => why_no_command({ store, session: signal(session) });
  const with_role = (role: Session['role']): Session => ({ auth_required: true, name: 'vic', role });

  it('need the operator role and a connection', () => {
    expect(why(with_role('viewer'))).toMatch(/needs the operator role/);
    store.set_link({ status: 'recording', name: 'r' });
    expect([why(with_role('operator')), why_not_permitted(with_role('operator'))]).toEqual(['A recording is shown, not the live cell', null]);
    store.set_link({ status: 'open' });
    expect([with_role('operator'), with_role('admin'), { auth_required: false, name: null, role: 'admin' as const }, null].map(why)).toEqual([null, null, null, null]);
  });
});
