// Poses of the wire as three.js takes them.
import { Quaternion, Vector3 } from 'three';

export function place(object, { position, quaternion }) {
  object.position.fromArray(position);
  object.quaternion.fromArray(quaternion);
}

/** A point of the tool in world axes. */
export function tipOf({ position, quaternion }, local) {
  return local.clone().applyQuaternion(new Quaternion().fromArray(quaternion)).add(new Vector3(...position));
}
