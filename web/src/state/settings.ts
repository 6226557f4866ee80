// The settings that this browser stores.

import { signal } from '@preact/signals';
import { forget_inks } from './palette';

export type Theme = 'system' | 'dark' | 'light';
export type ShownTheme = 'dark' | 'light';

/** The optional parts of the 3D view: tool paths with authority, ghosts of end positions, closest pairs. */
export interface Shows { paths: boolean; ghosts: boolean; distances: boolean }

const kShowsAll: Shows = { paths: true, ghosts: true, distances: true };
const kPersonKey = 'armloom.person';
const kShowsKey = 'armloom.shows';
const kThemes: readonly Theme[] = ['system', 'dark', 'light'];
const kThemeKey = 'armloom.theme';
const kKeysKey = 'armloom.letter-keys';

/** The storage; if the browser refuses it, settings last as long as the page. */
export interface Shelf { getItem(key: string): string | null; setItem(key: string, value: string): void }

export class Settings {
  readonly theme = signal<Theme>('system');
  readonly shown_theme = signal<ShownTheme>('dark');
  /** Enables single letters as page keys; F8 always stops. */
  readonly letter_keys = signal(true);
  /** The name of the user, for acknowledgements. */
  readonly person = signal('');
  /** The optional parts of the 3D view. */
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
      // Without storage the setting lasts as long as the page.
    }
  }
}
