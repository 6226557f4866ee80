// Returns why the policy cannot be changed now, or null if it can. The server refuses a change while
// jobs are admitted. Pure.

import type { Store } from '../state/store';
import { kText } from '../strings';

export function why_no_change(store: Pick<Store, 'jobs'>): string | null {
  const admitted = store.jobs('running').length + store.jobs('scheduled').length;
  return admitted === 0 ? null : kText.policies.admitted(admitted);
}
