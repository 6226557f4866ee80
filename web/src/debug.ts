// `window.armloom`: for the browser test, and for looking at a running page from the console.
//
//   armloom.q()                           joint name -> measured position
//   armloom.jobs()                        every job that the page knows, as the server wrote it
//   armloom.objects()                     the objects of the scene
//   armloom.is_drawn()                    whether every robot of the cell stands in the view
//   armloom.drawn()                       a promise, kept once all that changed has been drawn
//   armloom.pictures()                    how many have been drawn
//   armloom.level()                       how finely: what the view leaves out on a busy machine
//   armloom.set_robot_visible(name, yes)  draws the cell with or without one robot, so that a
//                                         picture of each tells which pixels are that robot's

import type { Store } from './store';
import type { CellView } from './view/cell_view';
import type { Level } from './view/pace';

export interface DebugHook {
  q(): Record<string, number>;
  jobs(): unknown[];
  objects(): unknown[];
  is_drawn(): boolean;
  drawn(): Promise<void>;
  pictures(): number;
  level(): Level;
  set_robot_visible(name: string, visible: boolean): void;
}

declare global {
  interface Window { armloom?: DebugHook }
}

export function install_debug_hook(store: Store, view: CellView): void {
  window.armloom = {
    q: () => ({ ...store.q }),
    jobs: () => store.all_jobs(),
    objects: () => [...store.objects],
    is_drawn: () => view.is_drawn(),
    drawn: () => view.drawn(),
    pictures: () => view.pictures(),
    level: () => view.level(),
    set_robot_visible: (name, visible) => view.set_robot_visible(name, visible),
  };
}
