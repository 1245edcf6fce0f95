#include <folk/mpe/players/player.h>

namespace folk::mpe {

void Player::start(const Layout&, const Block&, std::size_t, const Moment&) {}

}  // namespace folk::mpe
