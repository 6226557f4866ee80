// What this browser remembers of how the page is to look and to be used.

import { signal } from '@preact/signals';
import { forget_inks } from './palette';

export type Theme = 'system' | 'dark' | 'light';
export type ShownTheme = 'dark' | 'light';

const kThemes: readonly Theme[] = ['system', 'dark', 'light'];
const kThemeKey = 'armloom.theme';
const kKeysKey = 'armloom.letter-keys';

/** Where it is kept; a browser may refuse it, then it lasts as long as the page. */
export interface Shelf { getItem(key: string): string | null; setItem(key: string, value: string): void }

export class Settings {
  readonly theme = signal<Theme>('system');
  readonly shown_theme = signal<ShownTheme>('dark');
  /** Whether single letters lead to pages; F8 stops in any case. */
  readonly letter_keys = signal(true);

  constructor(
    private readonly shelf_: Shelf | null, private readonly prefers_light_: MediaQueryList | null,
    private readonly show_: (theme: ShownTheme) => void,
  ) {
    const theme = this.read(kThemeKey);
    this.theme.value = kThemes.find((known) => known === theme) ?? 'system';
    this.letter_keys.value = this.read(kKeysKey) !== 'off';
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
      // A browser that keeps nothing: it lasts as long as the page.
    }
  }
}
