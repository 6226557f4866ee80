// `window.armloom`: for the browser test, and for looking at a running page from the console.
//
//   armloom.q()                           joint name -> measured position
//   armloom.jobs()                        every job that the page knows, as the server wrote it
//   armloom.objects()                     the objects of the scene
//   armloom.numbers()                     of events: the last one, and how many were missed or came twice
//   armloom.lanes()                       what the timeline shows of each arm
//   armloom.is_drawn()                    whether every robot of the cell stands in the view
//   armloom.drawn()                       a promise, kept once all that changed has been drawn
//   armloom.where_is(object)              its middle, px from the view's top left
//   armloom.where_is_tool()               the same of the tool that is in hand
//   armloom.ahead()                       how many ways ahead are drawn
//   armloom.ghost()                       joints that stand as a ghost: a preview, or what a diagram points at
//   armloom.break_connection()            as if the network had: it is opened again
//   armloom.pictures()                    how many have been drawn
//   armloom.level()                       how finely: what the view leaves out on a busy machine
//   armloom.set_robot_visible(name, yes)  draws the cell with or without one robot, so that a
//                                         picture of each tells which pixels are that robot's

import type { App } from './state/app';
import { known_lanes } from './timeline/known';
import type { CellView } from './view/cell_view';
import type { Level } from './view/pace';

export interface DebugHook {
  q(): Record<string, number>;
  jobs(): unknown[];
  objects(): unknown[];
  numbers(): { last: number; missed: number; doubled: number };
  lanes(): unknown[];
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
    numbers: () => ({ ...store.numbers }),
    lanes: () => known_lanes(app, 0),
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
