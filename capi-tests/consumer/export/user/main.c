#include "wrap.h"

int main(void)
{
    return wrap_cube() == 6 ? 0 : 1;
}
