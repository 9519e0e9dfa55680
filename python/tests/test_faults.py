"""Every allocation of a call fails in turn: OutOfMemoryError, or the right answer. Only where the extension was
compiled with CORE_FAULTS, as scripts/python-sanitized does."""

import numpy as np
import pytest

import froe

from test_references import CALLS, SEGMENTS, TREE

pytestmark = pytest.mark.skipif(not hasattr(froe._core, "fail_after"), reason="compiled without CORE_FAULTS")


def attempt(call, count):
    """Did the call fail with so many allocations?"""
    froe._core.fail_after(count)
    try:
        call()
    except MemoryError:
        return True
    except AssertionError:  # of refused(): another failure came first
        return True
    finally:
        froe._core.fail_after(-1)
    return False


@pytest.mark.parametrize("name", [name for name in CALLS if not name.endswith("refused")])
def test_each_allocation(name):
    call, failed = CALLS[name], 0
    while attempt(call, failed):
        failed += 1
        assert failed < 3000
    call()


def test_a_batch_that_fails_leaves_the_scene():
    scene, failed = froe.segments(SEGMENTS), 0
    while attempt(lambda: scene.add_segments(SEGMENTS + 10), failed):
        failed += 1
        assert len(scene) == 3
    assert failed > 0 and len(scene) == 6
    assert np.array_equal(TREE.count([[0, 0, 9, 9]]), [3])
