/// stb's decoders, compiled here: Debian's library keeps their assertions, which damaged JPG files fail, and that would
/// abort the process. Without them such files decode to some picture or are refused.

#define STB_IMAGE_IMPLEMENTATION
#define STBI_ASSERT(condition) static_cast<void>(0)
#include <stb/stb_image.h>
