// Something is moved by hand: by arrows along the world's axes or by its middle, or turned by rings about
// its own axes. What comes of it is asked of the server when it is let go.

import * as THREE from 'three';
import { TransformControls } from 'three/addons/controls/TransformControls.js';
import type { Stage } from './stage';

const kSize = 0.75;

export type Grip = 'move' | 'turn';

export class DragHandles {
  private readonly controls_: TransformControls;
  private object_: THREE.Object3D | null = null;

  /** `moved`: it was let go there. */
  constructor(stage: Stage, moved: (object: THREE.Object3D) => void) {
    this.controls_ = new TransformControls(stage.camera, stage.canvas);
    this.controls_.setSize(kSize);
    this.controls_.addEventListener('change', () => stage.invalidate(true));
    this.controls_.addEventListener('dragging-changed', ({ value }) => {
      stage.let_turn(value !== true);
      if (value !== true && this.object_) moved(this.object_);
    });
    stage.scene.add(this.controls_.getHelper());
  }

  /** This one may be moved; null: none. Answers whether it was another one before. */
  show(object: THREE.Object3D | null, grip: Grip = 'move'): boolean {
    this.controls_.setMode(grip === 'move' ? 'translate' : 'rotate');
    this.controls_.setSpace(grip === 'move' ? 'world' : 'local');
    if (object === this.object_) return false;
    if (this.controls_.dragging) this.controls_.reset();  // it is taken back: nobody was asked to move it
    this.object_ = object;
    if (object) this.controls_.attach(object);
    else this.controls_.detach();
    return true;
  }

  /** A handle is under the pointer: a click is no click on what is behind it. */
  get is_touched(): boolean {
    return this.object_ !== null && this.controls_.axis !== null;
  }

  close(): void {
    this.controls_.dispose();
  }
}
