"""What torch's tensors on the CPU are."""


class DLPack:
    """DLPack and no buffer protocol."""

    def __init__(self, of):
        self.of = of

    def __dlpack__(self, **arguments):
        return self.of.__dlpack__()

    def __dlpack_device__(self):
        return self.of.__dlpack_device__()
