import { signal } from '@preact/signals';
import { afterEach, describe, expect, it, vi } from 'vitest';
import { listen_to_keys } from '../src/frame/shortcuts';
import type { App } from '../src/state/app';

describe('Escape', () => {
  afterEach(() => vi.unstubAllGlobals());

  it('ends dragging first, and closes the page the next time', () => {
    vi.stubGlobal('document', { querySelector: () => null });
    const places: string[] = [];
    const dragged_object = signal<string | null>('crate');
    const router = { place: { page: 'scene' }, go: ({ page }: { page: string }) => places.push(page) };
    const window = new EventTarget();
    listen_to_keys({ dragged_object, router, settings: { letter_keys: signal(true) } } as unknown as App, window as unknown as Window);
    const press = () => window.dispatchEvent(Object.assign(new Event('keydown'), { key: 'Escape' }));
    press();
    expect([dragged_object.value, places]).toEqual([null, []]);
    press();
    expect(places).toEqual(['cell']);
  });
});
