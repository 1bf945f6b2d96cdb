#include "simulator/farm/centre.hpp"
#include "simulator/occam/alt.hpp"

namespace farm {

using namespace occam;

std::vector<renderer::Area> make_blocks(const renderer::Params& params, Block size) {
  const renderer::Area area = renderer::get_area(params);
  std::vector<renderer::Area> blocks;
  for (int y = area.y; y < area.y + area.height; y += size.height)
    for (int x = area.x; x < area.x + area.width; x += size.width)
      blocks.push_back({x, y, std::min(size.width, area.x + area.width - x),
                        std::min(size.height, area.y + area.height - y)});
  return blocks;
}

void block_coordination(const BlockSetup& setup, CoordinationChannels to,
                        CoordinationResult& result) {
  Command command;
  do in(to.from_interaction, command);
  while (!std::holds_alternative<Begin>(command.content));
  result.begin(setup.on_begin);

  std::size_t next = 0, in_farm = 0;
  bool sender_is_ready = false;
  Signal dummy;
  Intersection found;
  while (next < setup.blocks.size() || in_farm > 0)
    pri_alt(when(!sender_is_ready, to.from_sender, dummy, [&] { sender_is_ready = true; }),
            otherwise(sender_is_ready && next < setup.blocks.size(),
                      [&] {
                        out(to.into_sender, Task{setup.blocks[next++], BLOCK_BYTES});
                        sender_is_ready = false;
                        result.note_task(++in_farm);
                      }),
            when(to.from_workers, found, [&] {
              --in_farm;
              result.rays += found.block->rays;
              out(to.into_visualisation, found);
            }));
  result.end(setup.on_end);

  while (!std::holds_alternative<Quit>(command.content)) in(to.from_interaction, command);
  stop_all(to, sender_is_ready);
}

}  // namespace farm
