/** Vertex data of passes. */
import type { Pass } from "../generated/api";

type MeshSpec = Pass["mesh"];

export interface Mesh { draw(): void; dispose(): void; }

export function meshKey(spec: MeshSpec): string {
  if (spec.rule === "grid") return `grid ${spec.rows} ${spec.columns}`;
  return spec.rule === "fullscreen" ? spec.rule : `${spec.rule} ${spec.count}`;
}

/** Vertices (column/columns, row/rows), columns first, and two triangles a cell. */
export function gridData(rows: number, columns: number): { vertices: Float32Array; indices: Uint32Array } {
  const across = columns + 1;
  const vertices = new Float32Array((rows + 1) * across * 2);
  for (let i = 0; i < vertices.length / 2; i++) vertices.set([(i % across) / columns, Math.floor(i / across) / rows], 2 * i);
  const indices = new Uint32Array(rows * columns * 6);
  for (let cell = 0; cell < rows * columns; cell++) {
    const first = Math.floor(cell / columns) * across + (cell % columns);
    const next = first + across;
    indices.set([first, first + 1, next, next, first + 1, next + 1], 6 * cell);
  }
  return { vertices, indices };
}

export function makeMesh(gl: WebGL2RenderingContext, spec: MeshSpec): Mesh {
  const array = gl.createVertexArray();
  if (spec.rule !== "grid") {
    const mode = spec.rule === "points" ? gl.POINTS : gl.TRIANGLES;
    const count = spec.rule === "points" ? spec.count : spec.rule === "quads" ? 6 * spec.count : 3;
    const draw = () => {
      gl.bindVertexArray(array);
      gl.drawArrays(mode, 0, count);
    };
    return { draw, dispose: () => gl.deleteVertexArray(array) };
  }
  const { vertices, indices } = gridData(spec.rows, spec.columns);
  const vertexBuffer = gl.createBuffer();
  const indexBuffer = gl.createBuffer();
  gl.bindVertexArray(array);
  gl.bindBuffer(gl.ARRAY_BUFFER, vertexBuffer);
  gl.bufferData(gl.ARRAY_BUFFER, vertices, gl.STATIC_DRAW);
  gl.enableVertexAttribArray(0);
  gl.vertexAttribPointer(0, 2, gl.FLOAT, false, 0, 0);
  gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, indexBuffer);
  gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, indices, gl.STATIC_DRAW);
  gl.bindVertexArray(null);
  const draw = () => {
    gl.bindVertexArray(array);
    gl.drawElements(gl.TRIANGLES, indices.length, gl.UNSIGNED_INT, 0);
  };
  const dispose = () => {
    gl.deleteVertexArray(array);
    gl.deleteBuffer(vertexBuffer);
    gl.deleteBuffer(indexBuffer);
  };
  return { draw, dispose };
}
