"""Small modules that others rest on: services looked up when they are used."""

import runpy
import sys
from types import ModuleType

import pytest

from qe import services
from qe.proof.on_demand import OnDemand
from qe.services import Service


def test_a_service_is_loaded_when_it_is_looked_up(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(services, "_LOADERS", {})
    loaded: list[int] = []
    services.provide({Service.REGION: lambda: loaded.append(1) or "value"})
    assert not loaded and services.service(Service.REGION) == "value" and loaded == [1]
    services.provide({Service.SYMPY: lambda: lambda value: ("written", value)})
    value = services.SymPyForm()
    assert value._sympy_() == ("written", value)
    with pytest.raises(KeyError):
        services.service(Service.WRITTEN)


@pytest.mark.parametrize("name", Service)
def test_every_service_is_provided(name: Service) -> None:
    assert callable(services.service(name)) or isinstance(services.service(name), ModuleType)
    assert hasattr(services.service(Service.REGION_OPERATORS), "joined")


def test_the_package_is_the_command(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    monkeypatch.setattr(sys, "argv", ["qe", "--version"])
    with pytest.raises(SystemExit) as end:
        runpy.run_module("qe.__main__", run_name="__main__")
    assert end.value.code == 0 and capsys.readouterr().out.startswith("qe ")
    import qe.__main__ as imported  # importing runs nothing

    assert callable(imported.main)


def test_certificates_are_made_when_asked_for() -> None:
    made: list[int] = []
    promised = OnDemand(lambda: made.append(1) or [])
    assert not made and promised.make() == [] and made == [1]
