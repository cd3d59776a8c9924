// Compiled with -mfma -ffp-contract=fast.
#define ONSET_ISA values_contracted
#define ONSET_KERNEL_VALUES kernel_values_contracted
#define ONSET_CERTIFICATES certificates_contracted
#define ONSET_CONTACT_VALUES contact_values_contracted
#include "tests/narrowphase/kernel/kernel_values.inl"
