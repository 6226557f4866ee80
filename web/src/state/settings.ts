// The settings of the dashboard. They are stored in the browser.

import { signal } from '@preact/signals';
import { forget_inks } from './palette';

export type Theme = 'system' | 'dark' | 'light';
export type ShownTheme = 'dark' | 'light';

/**
 * Which optional parts of the 3D view are shown: tool paths with authority, ghosts at the end
 * positions, and distances of the closest pairs.
 */
export interface Shows { paths: boolean; ghosts: boolean; distances: boolean }

const kShowsAll: Shows = { paths: true, ghosts: true, distances: true };
const kPersonKey = 'armloom.person';
const kShowsKey = 'armloom.shows';
const kThemes: readonly Theme[] = ['system', 'dark', 'light'];
const kThemeKey = 'armloom.theme';
const kKeysKey = 'armloom.letter-keys';

/** The browser's storage. If the browser refuses it, settings last only as long as the page. */
export interface Shelf { getItem(key: string): string | null; setItem(key: string, value: string): void }

export class Settings {
  readonly theme = signal<Theme>('system');
  readonly shown_theme = signal<ShownTheme>('dark');
  /** True if single letters open pages. F8 stops all arms in any case. */
  readonly letter_keys = signal(true);
  /** The name that the user gives when acknowledging alerts. */
  readonly person = signal('');
  /** Which optional parts of the 3D view are shown. */
  readonly shows = signal<Shows>(kShowsAll);

  constructor(
    private readonly shelf_: Shelf | null, private readonly prefers_light_: MediaQueryList | null,
    private readonly show_: (theme: ShownTheme) => void,
  ) {
    const theme = this.read(kThemeKey);
    this.theme.value = kThemes.find((known) => known === theme) ?? 'system';
    this.letter_keys.value = this.read(kKeysKey) !== 'off';
    this.person.value = this.read(kPersonKey) ?? '';
    const hidden = (this.read(kShowsKey) ?? '').split(' ');
    this.shows.value = { paths: !hidden.includes('paths'), ghosts: !hidden.includes('ghosts'), distances: !hidden.includes('distances') };
    prefers_light_?.addEventListener('change', () => this.apply());
    this.apply();
  }

  set_theme(theme: Theme): void {
    this.theme.value = theme;
    this.write(kThemeKey, theme);
    this.apply();
  }

  set_letter_keys(on: boolean): void {
    this.letter_keys.value = on;
    this.write(kKeysKey, on ? 'on' : 'off');
  }

  set_person(name: string): void {
    this.person.value = name;
    this.write(kPersonKey, name);
  }

  set_shows(shows: Shows): void {
    this.shows.value = shows;
    this.write(kShowsKey, Object.entries(shows).flatMap(([what, shown]) => (shown ? [] : [what])).join(' '));
  }

  private apply(): void {
    const theme = this.theme.value;
    const shown = theme !== 'system' ? theme : this.prefers_light_?.matches ? 'light' : 'dark';
    this.show_(shown);
    forget_inks();
    this.shown_theme.value = shown;
  }

  private read(key: string): string | null {
    try {
      return this.shelf_?.getItem(key) ?? null;
    } catch {
      return null;
    }
  }

  private write(key: string, value: string): void {
    try {
      this.shelf_?.setItem(key, value);
    } catch {
      // The browser refuses its storage, so the setting lasts only as long as the page.
    }
  }
}
