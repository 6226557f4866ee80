// `window.armloom`: for browser tests, and for debugging in the console.
//
//   armloom.q()                           joint name -> measured position
//   armloom.jobs()                        all jobs that the page knows, as the server sent them
//   armloom.objects()                     the objects of the scene
//   armloom.held()                        the objects that arms hold
//   armloom.numbers()                     the last event number; counts of missed and doubled events
//   armloom.lanes()                       the timeline of each arm
//   armloom.halts()                       the periods in which each arm was stopped
//   armloom.is_drawn()                    true if every robot of the cell is in the view
//   armloom.drawn()                       a promise that resolves when all changes are drawn
//   armloom.where_is(object)              the object's center, px from the view's top left
//   armloom.where_is_tool()               the same for the dragged tool goal
//   armloom.ahead()                       number of drawn tool paths
//   armloom.ghost()                       joints of the ghost: a preview, or a point of a diagram
//   armloom.break_connection()            breaks the connection; the page reconnects
//   armloom.pictures()                    number of drawn frames
//   armloom.level()                       what the view leaves out on a busy machine
//   armloom.set_robot_visible(name, yes)  shows or hides a robot, to find its pixels

import type { App } from './state/app';
import { known_lanes } from './timeline/known';
import type { CellView } from './view/cell_view';
import type { Level } from './view/pace';

export interface DebugHook {
  q(): Record<string, number>;
  jobs(): unknown[];
  objects(): unknown[];
  held(): unknown[];
  numbers(): { last: number; missed: number; doubled: number };
  lanes(): unknown[];
  halts(): Record<string, unknown>;
  is_drawn(): boolean;
  drawn(): Promise<void>;
  where_is(object: string): { x: number; y: number } | null;
  where_is_tool(): { x: number; y: number } | null;
  ahead(): number;
  ghost(): Readonly<Record<string, number>> | null;
  break_connection(): void;
  pictures(): number;
  level(): Level | null;
  set_robot_visible(name: string, visible: boolean): void;
}

declare global {
  interface Window { armloom?: DebugHook }
}

let view: CellView | null = null;

export function show_debug_view(shown: CellView): void {
  view = shown;
}

export function install_debug_hook(app: App, break_connection: () => void): void {
  const { store } = app;
  window.armloom = {
    q: () => ({ ...store.q }),
    jobs: () => store.all_jobs(),
    objects: () => [...store.objects],
    held: () => [...store.held],
    numbers: () => ({ ...store.numbers }),
    lanes: () => known_lanes(app, 0),
    halts: () => Object.fromEntries(store.halts),
    is_drawn: () => view?.is_drawn() ?? false,
    drawn: () => view?.drawn() ?? Promise.reject(new Error('the view is not loaded yet')),
    where_is: (object) => view?.where_is(object) ?? null,
    where_is_tool: () => view?.where_is_tool() ?? null,
    ahead: () => view?.ahead() ?? 0,
    ghost: () => app.ghost.value,
    break_connection,
    pictures: () => view?.pictures() ?? 0,
    level: () => view?.level() ?? null,
    set_robot_visible: (name, visible) => view?.set_robot_visible(name, visible),
  };
}
