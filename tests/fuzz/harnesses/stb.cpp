/// The decoders of stb, in place of those in Debian's library.
#define STB_IMAGE_IMPLEMENTATION
#include <stb/stb_image.h>
