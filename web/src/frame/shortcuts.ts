// Keys of the page. F8 stops all arms, from anywhere on the page. Escape ends dragging, else
// returns to the cell. Single letters open pages, unless the user is typing or has turned them off.

import type { App } from '../state/app';
import { kPageOfKey } from './pages';
import { kStopKey } from './stop_button';

export function listen_to_keys(app: App, window: Pick<Window, 'addEventListener'>): void {
  window.addEventListener('keydown', (event) => {
    if (event.key === kStopKey) {
      event.preventDefault();
      if (!event.repeat) void app.actions.stop();
      return;
    }
    if (event.ctrlKey || event.metaKey || event.altKey || event.defaultPrevented) return;
    if (document.querySelector('dialog[open], .more-pages[open]')) return;
    if (event.key === 'Escape' && app.dragged_object.value !== null) {
      app.dragged_object.value = null;
      return;
    }
    if (event.key === 'Escape' && app.router.place.page !== 'cell') return app.router.go({ page: 'cell' });
    const page = kPageOfKey.get(event.key);
    if (!page || !app.settings.letter_keys.value || is_typing(event.target)) return;
    event.preventDefault();
    app.router.go(page.place(app));
  }, { capture: true });
}

function is_typing(target: EventTarget | null): boolean {
  return target instanceof HTMLElement && (target.isContentEditable || /^(INPUT|TEXTAREA|SELECT)$/.test(target.tagName));
}
