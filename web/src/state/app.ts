// What every part of the page is given: what is known, what can be asked, where we are, how it looks.

import type { Signal } from '@preact/signals';
import type { JogControl } from '../control/jog_control';
import type { Archive } from '../history/archive';
import type { AlertList } from '../alerts/alert_list';
import type { Api } from '../server/api';
import type { Session } from '../server/messages';
import type { MotionBook } from '../motion/motion_book';
import type { Comparing } from '../policies/comparing';
import type { KeptList } from '../recordings/kept_list';
import type { Player } from '../recordings/player';
import type { Checklist } from '../recovery/checklist';
import type { Router } from '../route/router';
import type { Actions } from './actions';
import type { Seen } from './as_of';
import type { Settings } from './settings';
import type { Store } from './store';
import type { Tool } from '../view/tool_goal';

export interface App {
  /** Whoever reads it while it is drawn is drawn again when it changes. */
  readonly store: Store;
  api: Api;
  motions: MotionBook;
  actions: Actions;
  router: Router;
  /** The state at the instant that is looked at. */
  seen: Seen;
  player: Player;
  /** The recordings in the server's data folder. */
  kept: KeptList;
  settings: Settings;
  alerts: AlertList;
  comparing: Comparing;
  /** Jobs that the page was never told of. */
  archive: Archive;
  jogging: JogControl;
  /** What is looked at before arms that were stopped move again. */
  checklist: Checklist;
  /** Who uses this browser, where the server asks for tokens; null: not known yet. */
  session: Signal<Session | null>;
  /** The job, or the batch of jobs, that is being composed; it outlives the page's pane. */
  draft: Signal<string>;
  /** Joints as they would stand, shown in the cell; null: nothing is previewed. */
  ghost: Signal<Readonly<Record<string, number>> | null>;
  /** The object that may be moved by hand in the cell. */
  dragged_object: Signal<string | null>;
  /** The tool whose goal is dragged in the cell. */
  tool: Signal<Tool | null>;
  /** So much of the cell's left is covered by a pane. */
  covered_px: Signal<number>;
}
