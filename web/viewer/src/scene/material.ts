import { type Color, DoubleSide, type IUniform, MeshStandardMaterial } from 'three';

/** A matt material. Cavity shading darkens hollows a little and lightens ridges. */
export function surfaceMaterial(color: Color, scale: IUniform<number>): MeshStandardMaterial {
  const material = new MeshStandardMaterial({
    color,
    roughness: 0.62,
    metalness: 0,
    side: DoubleSide,
  });
  material.onBeforeCompile = (shader) => {
    shader.uniforms.scale = scale;
    shader.fragmentShader = shader.fragmentShader
      .replace('void main() {', `${CAVITY}\nvoid main() {`)
      .replace(
        '#include <opaque_fragment>',
        `outgoingLight *= cavity(normal, -vViewPosition);\n#include <opaque_fragment>`,
      );
  };
  return material;
}

// The change of the normal along the step to the next pixel is a curvature, positive where the
// surface is convex.
const CAVITY = /* glsl */ `
uniform float scale;
float bend(vec3 normalStep, vec3 step) {
  return dot(normalStep, step) / max(dot(step, step), 1e-12);
}
float cavity(vec3 normal, vec3 position) {
  float curvature = bend(dFdx(normal), dFdx(position)) + bend(dFdy(normal), dFdy(position));
  float side = gl_FrontFacing ? 1.0 : 0.6;  // back faces are darker
  return side * (1.0 + 0.22 * clamp(curvature * scale * 0.03, -1.3, 0.8));
}`;
