// The object that every part of the page receives: state, commands, address, settings.

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
  /** The state. A component that reads this member is drawn again when the state changes. */
  readonly store: Store;
  api: Api;
  motions: MotionBook;
  actions: Actions;
  router: Router;
  /** The state at the shown time, which may be a past time. */
  seen: Seen;
  player: Player;
  /** The recordings on the server. */
  kept: KeptList;
  settings: Settings;
  alerts: AlertList;
  comparing: Comparing;
  /** Ended jobs that the page did not receive as events, such as jobs of previous sessions. */
  archive: Archive;
  jogging: JogControl;
  /** The checklist that a user must confirm before stopped arms move again. */
  checklist: Checklist;
  /** The user of this browser and the user's role. Null until the server has answered. */
  session: Signal<Session | null>;
  /** The text of the job or batch being composed. It stays when the page New job is closed. */
  draft: Signal<string>;
  /** Joint positions of the ghost in the 3D view, or null if no ghost is shown. */
  ghost: Signal<Readonly<Record<string, number>> | null>;
  /** The name of the object that can be dragged in the 3D view, or null. */
  dragged_object: Signal<string | null>;
  /** The tool goal that is dragged in the 3D view. */
  tool: Signal<Tool | null>;
  /** The width of the pane, which covers the left part of the 3D view. */
  covered_px: Signal<number>;
}
