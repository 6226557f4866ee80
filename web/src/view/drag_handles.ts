// Handles to drag an object in the 3D view: arrows along the world's axes, or rings about the
// object's own axes. The new pose is reported when the user releases the handle.

import * as THREE from 'three';
import { TransformControls } from 'three/addons/controls/TransformControls.js';
import type { Stage } from './stage';

const kSize = 0.75;

export type Grip = 'move' | 'turn';

export class DragHandles {
  private readonly controls_: TransformControls;
  private object_: THREE.Object3D | null = null;

  /** `moved` is called when the user releases a handle. */
  constructor(stage: Stage, moved: (object: THREE.Object3D) => void) {
    this.controls_ = new TransformControls(stage.camera, stage.canvas);
    this.controls_.setSize(kSize);
    this.controls_.addEventListener('change', () => stage.invalidate(true));
    this.controls_.addEventListener('dragging-changed', ({ value }) => {
      stage.enable_turning(value !== true);
      if (value !== true && this.object_) moved(this.object_);
    });
    stage.scene.add(this.controls_.getHelper());
  }

  /**
   * Attaches the handles to an object, or hides them if `object` is null. Returns true if this is
   * another object than before.
   */
  show(object: THREE.Object3D | null, grip: Grip = 'move'): boolean {
    this.controls_.setMode(grip === 'move' ? 'translate' : 'rotate');
    this.controls_.setSpace(grip === 'move' ? 'world' : 'local');
    if (object === this.object_) return false;
    if (this.controls_.dragging) this.controls_.reset();  // undoes a drag that the user has not finished
    this.object_ = object;
    if (object) this.controls_.attach(object);
    else this.controls_.detach();
    return true;
  }

  /**
   * True if the pointer is on a handle. A click is then not meant for what is behind the handle.
   */
  get is_touched(): boolean {
    return this.object_ !== null && this.controls_.axis !== null;
  }

  close(): void {
    this.controls_.dispose();
  }
}
