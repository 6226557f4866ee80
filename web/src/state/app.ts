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
  /** Components that read it are drawn again when it changes. */
  readonly store: Store;
  api: Api;
  motions: MotionBook;
  actions: Actions;
  router: Router;
  /** The state at the shown time. */
  seen: Seen;
  player: Player;
  /** The recordings on the server. */
  kept: KeptList;
  settings: Settings;
  alerts: AlertList;
  comparing: Comparing;
  /** Ended jobs that the page did not receive as events. */
  archive: Archive;
  jogging: JogControl;
  /** The checklist before stopped arms move again. */
  checklist: Checklist;
  /** The user of this browser if the server requires tokens; null until known. */
  session: Signal<Session | null>;
  /** The text of the job or batch being composed; it outlives the page's pane. */
  draft: Signal<string>;
  /** Joints of the ghost in the 3D view, or null. */
  ghost: Signal<Readonly<Record<string, number>> | null>;
  /** The object that can be dragged in the 3D view. */
  dragged_object: Signal<string | null>;
  /** The tool goal that is dragged in the 3D view. */
  tool: Signal<Tool | null>;
  /** The width of the pane that covers the left of the 3D view. */
  covered_px: Signal<number>;
}
