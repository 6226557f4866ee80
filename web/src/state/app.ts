// What every part of the page is given: what is known, what can be asked, where we are, how it looks.

import type { Signal } from '@preact/signals';
import type { Api } from '../server/api';
import type { Router } from '../route/router';
import type { Actions } from './actions';
import type { Settings } from './settings';
import type { Store } from './store';

export interface App {
  store: Store;
  api: Api;
  actions: Actions;
  router: Router;
  settings: Settings;
  /** Joints as they would stand, shown in the cell; null: nothing is previewed. */
  ghost: Signal<Readonly<Record<string, number>> | null>;
  /** So much of the cell's left is covered by a pane. */
  covered_px: Signal<number>;
}
