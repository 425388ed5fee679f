#!/usr/bin/python3
# SPDX-FileCopyrightText: The Orbweave authors
# SPDX-License-Identifier: BSD-3-Clause
"""Prints deploy/kubernetes/base as `podman kube play` takes it: tests/deploy/for_podman.py IMAGE KEYS

Of it stays what runs: the pods with their arguments, users, roots that cannot be written and volumes. Otherwise:
  StatefulSet                        a Pod and a PersistentVolumeClaim of user 10001 (podman has no fsGroup)
  Service                            the network of this machine: localhost in place of the Service's name
  $(POD_NAME)                        "pod": podman 4.3 puts no variables into arguments
  Secrets                            the folders KEYS/coordinator and KEYS/workers of this machine, for the same reason
  probes                             none: podman runs them by a curl in the image; who calls this asks the pages itself
  NetworkPolicy, PodDisruptionBudget, ServiceAccount   none
"""
import pathlib
import sys

import yaml

sys.dont_write_bytecode = True
import manifests  # noqa: E402


def adapt(spec, image, keys):
    for field in ("serviceAccountName", "automountServiceAccountToken"):
        del spec[field]
    for field in ("fsGroup", "fsGroupChangePolicy"):
        spec["securityContext"].pop(field, None)
    spec["hostNetwork"] = True
    container = spec["containers"][0]
    container["args"] = [arg.replace("=orbweave-coordinator:", "=localhost:").replace("$(POD_NAME)", "pod")
                         for arg in container["args"]]
    container["image"] = image
    container["imagePullPolicy"] = "Never"
    for field in ("startupProbe", "livenessProbe", "readinessProbe", "ports"):
        container.pop(field, None)
    for volume in spec["volumes"]:
        secret = volume.pop("secret", None)
        if secret:
            folder = {"orbweave-coordinator": "coordinator", "orbweave-worker": "workers"}[secret["secretName"]]
            volume["hostPath"] = {"path": str(keys / folder), "type": "Directory"}
    return spec


def main():
    image, keys = sys.argv[1], pathlib.Path(sys.argv[2]).resolve()
    played = []
    for thing in manifests.in_order(manifests.render(manifests.KUBERNETES / "base")):
        if thing["kind"] == "Deployment":
            adapt(thing["spec"]["template"]["spec"], image, keys)
            thing["spec"]["replicas"] = 1
            played.append(thing)
        if thing["kind"] == "StatefulSet":
            spec = adapt(thing["spec"]["template"]["spec"], image, keys)
            for claim in thing["spec"]["volumeClaimTemplates"]:
                claimed = f"{claim['metadata']['name']}-{thing['metadata']['name']}"
                spec["volumes"].append({"name": claim["metadata"]["name"], "persistentVolumeClaim": {"claimName": claimed}})
                owner = {"volume.podman.io/uid": "10001", "volume.podman.io/gid": "10001"}
                played.append({"apiVersion": "v1", "kind": "PersistentVolumeClaim",
                               "metadata": {"name": claimed, "annotations": owner}, "spec": claim["spec"]})
            played.append({"apiVersion": "v1", "kind": "Pod", "metadata": thing["metadata"], "spec": spec})
    yaml.safe_dump_all(played, sys.stdout, sort_keys=False)


main()
