import { describe, expect, it } from 'vitest';
import { Settings, type Shelf } from '../src/state/settings';

function shelf_of(kept: Record<string, string> = {}): Shelf & { kept: Record<string, string> } {
  return { kept, getItem: (key) => kept[key] ?? null, setItem: (key, value) => { kept[key] = value; } };
}

/** Returns a system whose preferred theme may change. */
function system_of(light: boolean) {
  const listeners: (() => void)[] = [];
  const query = { matches: light, addEventListener: (_: string, listener: () => void) => listeners.push(listener) };
  return { query: query as unknown as MediaQueryList, change: (to: boolean) => { query.matches = to; listeners.forEach((tell) => tell()); } };
}

describe('Settings', () => {
  it('are restored by the next page in the same browser', () => {
    const shelf = shelf_of();
    const first = new Settings(shelf, null, () => undefined);
    first.set_theme('light');
    first.set_letter_keys(false);
    first.set_person('Ada');
    first.set_shows({ paths: true, ghosts: false, distances: false });
    const next = new Settings(shelf, null, () => undefined);
    expect([next.theme.value, next.shown_theme.value, next.letter_keys.value, next.person.value]).toEqual(['light', 'light', false, 'Ada']);
    expect(next.shows.value).toEqual({ paths: true, ghosts: false, distances: false });
  });

  it('are the defaults at first, and for invalid stored values', () => {
    for (const shelf of [null, shelf_of(), shelf_of({ 'armloom.theme': 'pink', 'armloom.shows': 'everything', 'armloom.letter-keys': '?' })]) {
      const { theme, letter_keys, person, shows } = new Settings(shelf, null, () => undefined);
      expect([theme.value, letter_keys.value, person.value]).toEqual(['system', true, '']);
      expect(shows.value).toEqual({ paths: true, ghosts: true, distances: true });
    }
  });

  it('last as long as the page without storage', () => {
    const refuse = () => { throw new DOMException('denied', 'SecurityError'); };
    const settings = new Settings({ getItem: refuse, setItem: refuse }, null, () => undefined);
    settings.set_theme('light');
    settings.set_person('Ada');
    expect([settings.theme.value, settings.person.value]).toEqual(['light', 'Ada']);
  });

  it('follow the system\'s theme and its changes unless a theme was chosen', () => {
    const shown: string[] = [];
    const { query, change } = system_of(true);
    const settings = new Settings(shelf_of(), query, (theme) => shown.push(theme));
    change(false);
    expect([shown, settings.shown_theme.value]).toEqual([['light', 'dark'], 'dark']);
    settings.set_theme('light');
    change(false);
    expect(settings.shown_theme.value).toBe('light');
    settings.set_theme('system');
    expect(settings.shown_theme.value).toBe('dark');
  });
});
