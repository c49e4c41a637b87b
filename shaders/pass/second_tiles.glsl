// SPDX-License-Identifier: MIT
// Where tiles of a view lie in the buffer of second pixels, see LIST_HEAD. The first tile starts at
// the rectangle's first second pixel.

uvec2 secondsOfView() {
  return uvec2(frame.viewport.xy) / 2u + 2u;
}

uvec2 tilesOfView() {
  return (secondsOfView() + TILE_SECONDS - 1u) / TILE_SECONDS;
}

uint tileAddress(uvec2 tile) {
  uvec2 ofView = secondsOfView();
  return LIST_HEAD + (SECOND_SIZE + LIST_MOST) * ofView.x * ofView.y + tile.y * tilesOfView().x +
         tile.x;
}

uint tileListAddress() {
  return tileAddress(uvec2(0u, tilesOfView().y));
}

// Where rows of tiles start and the list of other tiles ends.
uint rowsAddress() {
  return tileAddress(uvec2(0u, 2u * tilesOfView().y));
}
