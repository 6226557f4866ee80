import { effect } from '@preact/signals';
import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { seen } from '../src/state/seen';
import { Store } from '../src/state/store';

describe('Seen store', () => {
  beforeEach(() => { vi.useFakeTimers(); });
  afterEach(() => { vi.useRealTimers(); });

  it('redraws its readers after a change, once per burst, and nothing else', () => {
    const store = new Store();
    const drawn: string[] = [];
    // An effect stands for a component: both run again when a signal that they read changes.
    const end = effect(() => { drawn.push(seen(store).link.status); });
    let aside = 0;
    const end_aside = effect(() => { aside += 1; });
    store.set_link({ status: 'open' });
    store.set_stopped(true);
    vi.advanceTimersByTime(100);
    expect(drawn).toEqual(['connecting', 'open']);
    store.set_link({ status: 'lost', retry_in_ms: 0 } as never);
    vi.advanceTimersByTime(1000);
    expect(drawn).toEqual(['connecting', 'open', 'lost']);
    expect(aside).toBe(1);
    end();
    end_aside();
    store.set_stopped(false);
    vi.advanceTimersByTime(1000);
    expect(drawn).toHaveLength(3);
  });
});
