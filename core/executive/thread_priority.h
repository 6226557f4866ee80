#pragma once

namespace armloom {

// How soon the calling thread gets a processor when others want it too; on Linux, and as far as the
// system allows it (RLIMIT_NICE): otherwise nothing changes. No real-time class: whatever it does,
// the others get their share.
void go_first();  // a control loop: most of what else runs here waits
void give_way();  // whatever else runs here goes first

}  // namespace armloom
