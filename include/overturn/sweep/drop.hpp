// How whatever takes long is interrupted.
#pragma once

#include <functional>

namespace overturn {

/// Asked every second or more often while a tile is computed, by its own thread. Once it is true it
/// stays so, and TileDropped leaves whatever computes the tile.
using DropRequested = std::function<bool()>;
class TileDropped {};

} // namespace overturn
