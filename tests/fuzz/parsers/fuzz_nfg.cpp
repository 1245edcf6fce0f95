// read_nfg: whatever is read is written in both forms and read back as the same game.

#include <folk/games/stage_games/nfg.h>

#include "fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return folk::fuzz::only_folk_errors(data, size, [](std::string_view text) {
    const folk::StageGame game = folk::read_nfg(text, "fuzz.nfg");
    for (const folk::NfgForm form : {folk::NfgForm::payoff, folk::NfgForm::outcome}) {
      const folk::StageGame back = folk::read_nfg(folk::write_nfg(game, form), "fuzz.nfg");
      folk::fuzz::require(back.same_game(game) && back.title() == game.title() && back.comment() == game.comment());
    }
  });
}
