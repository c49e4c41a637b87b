// SPDX-License-Identifier: MIT
// Where the rays of pixels cross the triangles of a closed surface, without clipping (Olano and
// Greer 1997) and without cracks.
//
// A vertex is homogeneous, (x W, y W, W): the pixel that sees it, x to the right and y down, and
// its depth W along the view, negative behind the eye. Parallel projections have W = 1.
//
// Each pixel sees vertices from itself: the sides of edges are then signs of areas between nearby
// points, known to 1e-7 of them. Lines of the whole picture, which cost less, miss the vertices
// where they should meet by 0.03 pixels in a picture of 960, and pixels fall between. All triangles
// at a vertex see it at the same place, and those at an edge compute the same area but for its
// sign: with no product fused into the difference (`precise`), a b - c d and c d - a b round alike.

vec3 fromPixel(vec3 vertex, vec2 pixel) {
  precise vec3 moved = vec3(vertex.x - pixel.x * vertex.z, vertex.y - pixel.y * vertex.z, vertex.z);
  return moved;
}

// Between the pixel and an edge, from its first vertex to its second.
real edgeArea(vec3 first, vec3 second) {
  precise real area = first.x * second.y - first.y * second.x;
  return area;
}

// 1 or -1; of a pixel on the line that of a point infinitely little to the right of it, else below.
// 0: no line, since the eye looks along the edge.
real edgeSide(vec3 first, vec3 second, real area) {
  precise real right = first.y * second.z - first.z * second.y;
  precise real below = first.z * second.x - first.x * second.z;
  return sign(area != real(0.0f) ? area : (right != real(0.0f) ? right : below));
}

struct EdgeAt {
  real area;
  real side;
};

EdgeAt edgeAt(vec3 first, vec3 second) {
  EdgeAt edge;
  edge.area = edgeArea(first, second);
  edge.side = edgeSide(first, second, edge.area);
  return edge;
}

struct SurfaceCrossing {
  real facing;  // 1: front, whose vertices run against the clock; -1: back; 0: none
  real depth;   // between those of the vertices; crossings below 0 lie behind the eye
};

// `depths` are the vertices' own: W, or along a parallel projection what is asked for.
SurfaceCrossing surfaceCrossing(vec3 a, vec3 b, vec3 c, vec3 depths, vec2 pixel) {
  vec3 p = fromPixel(a, pixel);
  vec3 q = fromPixel(b, pixel);
  vec3 r = fromPixel(c, pixel);
  EdgeAt first = edgeAt(q, r);
  EdgeAt second = edgeAt(r, p);
  EdgeAt third = edgeAt(p, q);
  bool one = first.side == second.side && first.side == third.side;
  vec3 weight = abs(vec3(first.area, second.area, third.area));
  real sum = weight.x + weight.y + weight.z;
  SurfaceCrossing result;
  result.facing = one ? -first.side : real(0.0f);  // y points down
  // A pixel on all three lines sees a triangle of no size.
  result.depth = sum > real(0.0f) ? dot(weight, depths) / sum
                                  : (depths.x + depths.y + depths.z) / real(3.0f);
  return result;
}
