#!/usr/bin/python3
# SPDX-FileCopyrightText: The Orbweave authors
# SPDX-License-Identifier: BSD-3-Clause
"""Holds deploy/kubernetes against strict schemas of the kinds it uses, and against itself and the program.

    tests/deploy/manifests.py ORBWEAVE

No API server is asked: a field that a schema below allows and a cluster does not is not found out here. The base and
every overlay are rendered by what stands here of Kustomize, and by `kubectl kustomize` (5 or later) where there is one,
to the same. 77 where python3-yaml is missing.
"""
import copy
import json
import pathlib
import re
import shutil
import subprocess
import sys

try:
    import yaml
except ImportError:
    print("python3-yaml is missing", file=sys.stderr)
    sys.exit(77)

ROOT = pathlib.Path(__file__).resolve().parents[2] / "deploy"
KUBERNETES = ROOT / "kubernetes"
TEXT, NUMBER, FLAG = str, int, bool


class Wrong(Exception):
    """What does not fit, and where."""


def fits(value, schema, where):
    """Schemas: a type; [schema] a list; {"key": schema} all keys there may be, those with a ! there must be;
    {"*": schema} any keys; a set of allowed values; a function that says whether it fits."""
    if isinstance(schema, dict):
        if not isinstance(value, dict):
            raise Wrong(f"{where}: {value!r} is no mapping")
        if "*" in schema:
            for key, item in value.items():
                fits(item, schema["*"], f"{where}.{key}")
            return
        known = {key.rstrip("!"): part for key, part in schema.items()}
        for key, item in value.items():
            if key not in known:
                raise Wrong(f"{where}: there is no field {key}")
            fits(item, known[key], f"{where}.{key}")
        for key in schema:
            if key.endswith("!") and key[:-1] not in value:
                raise Wrong(f"{where}: {key[:-1]} is missing")
    elif isinstance(schema, list):
        if not isinstance(value, list):
            raise Wrong(f"{where}: {value!r} is no list")
        for number, item in enumerate(value):
            fits(item, schema[0], f"{where}[{number}]")
    elif isinstance(schema, set):
        if value not in schema:
            raise Wrong(f"{where}: {value!r} is none of {sorted(schema)}")
    elif isinstance(schema, type):
        if type(value) is not schema:
            raise Wrong(f"{where}: {value!r} is no {schema.__name__}")
    elif not schema(value):
        raise Wrong(f"{where}: {value!r} does not fit")


def name(text):
    return isinstance(text, str) and re.fullmatch(r"[a-z0-9]([-a-z0-9.]{0,61}[a-z0-9])?", text) is not None


def quantity(text):
    return isinstance(text, str) and re.fullmatch(r"[0-9]+([.][0-9]+)?(m|Ki|Mi|Gi|Ti)?", text) is not None


def port(value):
    return name(value) if isinstance(value, str) else type(value) is int and 1 <= value <= 65535


LABELS = {"*": TEXT}
META = {"name!": name, "labels": LABELS, "annotations": LABELS, "namespace": name}
SELECTOR = {"matchLabels": LABELS, "matchExpressions": [{"key!": TEXT, "operator!": {"In", "NotIn", "Exists"},
                                                         "values": [TEXT]}]}
PROBE = {"httpGet!": {"path!": TEXT, "port!": port}, "periodSeconds": NUMBER, "failureThreshold": NUMBER,
         "timeoutSeconds": NUMBER}
CONTAINER = {
    "name!": name, "image!": TEXT, "args!": [TEXT], "ports": [{"name!": name, "containerPort!": port}],
    "env": [{"name!": TEXT, "value": TEXT, "valueFrom": {"fieldRef": {"fieldPath!": {"metadata.name"}},
                                                              "secretKeyRef": {"name!": name, "key!": TEXT}}}],
    "envFrom": [{"secretRef!": {"name!": name}}],
    "startupProbe": PROBE, "livenessProbe": PROBE, "readinessProbe": PROBE,
    "resources!": {"requests!": {"cpu!": quantity, "memory!": quantity}, "limits!": {"memory!": quantity, "cpu": quantity}},
    "securityContext!": {"allowPrivilegeEscalation!": {False}, "readOnlyRootFilesystem!": {True},
                         "capabilities!": {"drop!": lambda drop: drop == ["ALL"]}},
    "volumeMounts!": [{"name!": name, "mountPath!": TEXT, "readOnly": FLAG}],
}
POD = {
    "serviceAccountName!": name, "automountServiceAccountToken!": {False}, "terminationGracePeriodSeconds!": NUMBER,
    "restartPolicy": {"Never", "OnFailure", "Always"},
    "securityContext!": {"runAsNonRoot!": {True}, "runAsUser!": {10001}, "runAsGroup!": {10001}, "fsGroup!": {10001},
                         "fsGroupChangePolicy": {"OnRootMismatch", "Always"},
                         "seccompProfile!": {"type!": {"RuntimeDefault"}}},
    "containers!": [CONTAINER],
    "volumes": [{"name!": name, "emptyDir": {"sizeLimit": quantity},
                 "secret": {"secretName!": name, "defaultMode": {0o440, 0o400},
                            "items": [{"key!": TEXT, "path!": TEXT}]}}],
}
TEMPLATE = {"metadata!": {"labels!": LABELS}, "spec!": POD}
SPECS = {
    ("v1", "Service"): {"clusterIP": {"None"}, "publishNotReadyAddresses": FLAG, "selector!": LABELS,
                        "ports!": [{"name!": name, "port!": port, "targetPort!": port}]},
    ("apps/v1", "StatefulSet"): {
        "serviceName!": name, "replicas!": {1}, "selector!": SELECTOR, "template!": TEMPLATE,
        "volumeClaimTemplates": [{"apiVersion": TEXT, "kind": TEXT, "metadata!": META, "spec!": {
            "accessModes!": [{"ReadWriteOnce"}], "storageClassName": name,
            "resources!": {"requests!": {"storage!": quantity}}}}]},
    ("apps/v1", "Deployment"): {"replicas!": NUMBER, "selector!": SELECTOR, "template!": TEMPLATE},
    ("policy/v1", "PodDisruptionBudget"): {"maxUnavailable!": NUMBER, "selector!": SELECTOR},
    ("networking.k8s.io/v1", "NetworkPolicy"): {
        "podSelector!": SELECTOR, "policyTypes!": [{"Ingress", "Egress"}],
        "ingress!": [{"from": [{"podSelector": SELECTOR, "namespaceSelector": SELECTOR}],
                      "ports!": [{"protocol!": {"TCP"}, "port!": port}]}]},
    ("keda.sh/v1alpha1", "ScaledJob"): {
        "pollingInterval": NUMBER, "minReplicaCount": NUMBER, "maxReplicaCount!": NUMBER,
        "successfulJobsHistoryLimit": NUMBER, "failedJobsHistoryLimit": NUMBER,
        "rollout!": {"strategy!": {"gradual"}}, "scalingStrategy!": {"strategy!": {"default"}},
        "triggers!": [{"type!": {"metrics-api"},
                       "metadata!": {"url!": TEXT, "valueLocation!": TEXT, "targetValue!": TEXT}}],
        "jobTargetRef!": {"backoffLimit!": NUMBER, "template!": TEMPLATE}},
    ("cert-manager.io/v1", "Issuer"): {"selfSigned": {}, "ca": {"secretName!": name}},
    ("cert-manager.io/v1", "Certificate"): {
        "isCA": FLAG, "commonName": TEXT, "secretName!": name, "duration": TEXT, "uris": [TEXT], "dnsNames": [TEXT],
        "usages": [{"server auth", "client auth", "digital signature"}],
        "privateKey!": {"algorithm!": {"ECDSA"}, "size!": {256}, "encoding!": {"PKCS8"}, "rotationPolicy": {"Always"}},
        "issuerRef!": {"kind!": {"Issuer"}, "name!": name}},
    ("monitoring.coreos.com/v1", "ServiceMonitor"): {
        "selector!": SELECTOR, "endpoints!": [{"port!": name, "path!": TEXT, "interval": TEXT}]},
    ("monitoring.coreos.com/v1", "PrometheusRule"): {"groups!": [{"name!": TEXT, "rules!": [
        {"alert!": TEXT, "expr!": TEXT, "for": TEXT, "labels": LABELS, "annotations": LABELS}]}]},
}


def check_schema(thing):
    where = f"{thing.get('kind')} {thing.get('metadata', {}).get('name')}"
    kind = (thing.get("apiVersion"), thing.get("kind"))
    head = {"apiVersion!": TEXT, "kind!": TEXT, "metadata!": META}
    if kind == ("v1", "ServiceAccount"):
        fits(thing, {**head, "automountServiceAccountToken!": {False}}, where)
    elif kind in SPECS:
        fits(thing, {**head, "spec!": SPECS[kind]}, where)
    else:
        raise Wrong(f"{where}: there is no schema of {kind}")


def want(condition, what):
    if not condition:
        raise Wrong(what)


def bytes_of(text):
    """Of a quantity of Kubernetes, or a size as Orbweave takes it."""
    number, unit = re.fullmatch(r"([0-9]+)([KMGT]i)?B?", text).groups()
    return int(number) * 1024 ** (" KMGT".index(unit[0]) if unit else 0)


KUSTOMIZATION = {
    "apiVersion!": {"kustomize.config.k8s.io/v1beta1", "kustomize.config.k8s.io/v1alpha1"},
    "kind!": {"Kustomization", "Component"}, "resources": [TEXT], "components": [TEXT], "configurations": [TEXT],
    "labels": [{"pairs!": LABELS}], "images": [{"name!": TEXT, "newName!": TEXT, "newTag!": TEXT}],
    "patches": [{"target": {"kind!": TEXT, "name!": TEXT}, "patch": TEXT, "path": TEXT}],
}


def template_of(thing):
    spec = thing.get("spec", {})
    return spec.get("template") or spec.get("jobTargetRef", {}).get("template")


def patch_one(thing, operations, where):
    """JSON Patch (RFC 6902), of which `add` is used."""
    for operation in operations:
        fits(operation, {"op!": {"add"}, "path!": TEXT, "value!": lambda value: True}, where)
        *parents, last = operation["path"].strip("/").split("/")
        place = thing
        for step in parents:
            try:
                place = place[int(step) if isinstance(place, list) else step]
            except (KeyError, IndexError, ValueError) as error:
                raise Wrong(f"{where}: there is no {operation['path']}") from error
        if isinstance(place, list):
            place.insert(len(place) if last == "-" else int(last), copy.deepcopy(operation["value"]))
        else:
            place[last] = copy.deepcopy(operation["value"])


def patch_all(things, patch, folder):
    text = patch["patch"] if "patch" in patch else (folder / patch["path"]).read_text()
    content = yaml.safe_load(text)
    if "target" in patch:
        for thing in things:
            if (thing["kind"], thing["metadata"]["name"]) == (patch["target"]["kind"], patch["target"]["name"]):
                patch_one(thing, content, str(folder))
        return things
    want(content.get("$patch") == "delete", f"{folder}: only deletions are patches without a target")
    left = [thing for thing in things
            if (thing["kind"], thing["metadata"]["name"]) != (content["kind"], content["metadata"]["name"])]
    want(len(left) == len(things) - 1, f"{folder}: nothing to delete")
    return left


def render(folder, things=None):
    """What Kustomize makes of a folder, on top of `things` where it is a component."""
    kustomization = yaml.safe_load((folder / "kustomization.yaml").read_text())
    fits(kustomization, KUSTOMIZATION, str(folder))
    want((kustomization["kind"] == "Component") == (things is not None), f"{folder}: {kustomization['kind']}")
    things = list(things or [])
    for resource in kustomization.get("resources", []):
        path = (folder / resource).resolve()
        want(path.exists(), f"{folder}: there is no {resource}")
        things += render(path) if path.is_dir() else list(yaml.safe_load_all(path.read_text()))
    for component in kustomization.get("components", []):
        things = render((folder / component).resolve(), things)
    for patch in kustomization.get("patches", []):
        things = patch_all(things, patch, folder)
    for label in kustomization.get("labels", []):
        for thing in things:
            thing["metadata"].setdefault("labels", {}).update(label["pairs"])
    for image in kustomization.get("images", []):
        for thing in things:
            for container in (template_of(thing) or {"spec": {"containers": []}})["spec"]["containers"]:
                if container["image"] == image["name"]:
                    container["image"] = f"{image['newName']}:{image['newTag']}"
    return things


def in_order(things):
    return sorted(things, key=lambda thing: (thing["kind"], thing["metadata"]["name"]))


def kustomize_version():
    """Of kubectl's Kustomize; 0: there is none."""
    if shutil.which("kubectl") is None:
        return 0
    asked = subprocess.run(["kubectl", "version", "--client", "-o", "json"], capture_output=True, text=True, check=False)
    try:
        return int(re.match(r"v([0-9]+)", json.loads(asked.stdout)["kustomizeVersion"])[1])
    except (ValueError, KeyError, TypeError):
        return 0


class Manifests:
    """All that `kubectl apply` would get."""

    def __init__(self, things):
        self.things = things

    def all(self, kind):
        return [thing for thing in self.things if thing["kind"] == kind]

    def pods(self):
        """Templates of pods, by the name of what makes them."""
        pods = {}
        for thing in self.things:
            template = template_of(thing)
            if template:
                pods[f"{thing['kind']}/{thing['metadata']['name']}"] = (thing, template)
        return pods

    def check(self, helps):
        seen = set()
        for thing in self.things:
            check_schema(thing)
            key = (thing["kind"], thing["metadata"]["name"])
            want(key not in seen, f"{key} is there twice")
            seen.add(key)
        want(len(self.all("StatefulSet")) == 1, "one coordinator")
        want(len(self.all("Deployment")) + len(self.all("ScaledJob")) == 1, "one kind of workers")
        for maker, (thing, template) in self.pods().items():
            self.check_pod(maker, thing, template, helps)
        self.check_selectors()
        self.check_coordinator()
        self.check_workers()
        self.check_certificates()

    def check_pod(self, maker, thing, template, helps):
        spec = template["spec"]
        want(len(spec["containers"]) == 1, f"{maker}: one container")
        container = spec["containers"][0]
        args = container["args"]
        want(re.fullmatch(r"[a-z0-9./-]+:[A-Za-z0-9._-]+", container["image"]), f"{maker}: image {container['image']}")
        for arg in args[1:]:
            option = arg.split("=")[0]
            want(re.search(rf"(^|[ ,]){option}\b(?!-)", helps[args[0]], re.M), f"{maker}: {args[0]} has no {option}")
        volumes = {volume["name"]: volume for volume in spec.get("volumes", [])}
        claims = {claim["metadata"]["name"] for claim in thing["spec"].get("volumeClaimTemplates", [])}
        mounts = [mount["name"] for mount in container["volumeMounts"]]
        want(sorted(mounts) == sorted(list(volumes) + list(claims)), f"{maker}: volumes and mounts differ")
        paths = {mount["mountPath"] for mount in container["volumeMounts"]}
        for option in ("--tls", "--state"):
            value = option_of(args, option)
            want(value is None or value in paths, f"{maker}: {option}={value} is no volume")
        account = [item["metadata"]["name"] for item in self.all("ServiceAccount")]
        want(spec["serviceAccountName"] in account, f"{maker}: no such account")
        names = {item["name"]: item["containerPort"] for item in container.get("ports", [])}
        for probe in ("startupProbe", "livenessProbe", "readinessProbe"):
            if probe in container:
                want(container[probe]["httpGet"]["port"] in names, f"{maker}: port of {probe}")
        for variable in re.findall(r"\$\((\w+)\)", " ".join(args)):
            want(variable in [item["name"] for item in container.get("env", [])], f"{maker}: no {variable}")

    def check_selectors(self):
        pods = [template["metadata"]["labels"] for _, template in self.pods().values()]

        def finds(labels):
            return any(all(pod.get(key) == value for key, value in labels.items()) for pod in pods)

        for maker, (thing, template) in self.pods().items():
            if "selector" in thing["spec"]:
                labels = thing["spec"]["selector"]["matchLabels"]
                own = template["metadata"]["labels"]
                want(all(own.get(key) == value for key, value in labels.items()), f"{maker}: its selector")
        for service in self.all("Service"):
            want(finds(service["spec"]["selector"]), "the service finds no pod")
        for kind, field in (("PodDisruptionBudget", "selector"), ("NetworkPolicy", "podSelector")):
            for thing in self.all(kind):
                want(finds(thing["spec"][field]["matchLabels"]), f"{kind} {thing['metadata']['name']} finds no pod")
        for monitor in self.all("ServiceMonitor"):
            wanted = monitor["spec"]["selector"]["matchLabels"].items()
            found = [service for service in self.all("Service")
                     if all(service["metadata"].get("labels", {}).get(key) == value for key, value in wanted)]
            want(len(found) == 1, "the monitor finds no service")
            ports = {item["name"] for item in found[0]["spec"]["ports"]}
            want(all(end["port"] in ports for end in monitor["spec"]["endpoints"]), "the monitor's port")

    def coordinator(self):
        return self.all("StatefulSet")[0]["spec"]["template"]["spec"]["containers"][0]

    def check_coordinator(self):
        container = self.coordinator()
        args = container["args"]
        names = {item["name"]: item["containerPort"] for item in container["ports"]}
        want(option_of(args, "--listen").endswith(f":{names['grpc']}"), "the port of --listen")
        want(option_of(args, "--http").endswith(f":{names['http']}"), "the port of --http")
        want("--http-open" in args, "kubelets come from other addresses")
        want(option_of(args, "--tls"), "beyond this machine only with --tls")
        startup = container["startupProbe"]
        want(startup["periodSeconds"] * startup["failureThreshold"] == 600, "10 minutes to start")
        want(startup["httpGet"]["path"] == "/livez" and container["livenessProbe"]["httpGet"]["path"] == "/livez",
             "/livez says whether to start it again")
        want(container["readinessProbe"]["httpGet"]["path"] == "/readyz", "/readyz says whether it can work")
        service = self.all("Service")[0]
        want(self.all("StatefulSet")[0]["spec"]["serviceName"] == service["metadata"]["name"], "the headless service")
        want({item["port"] for item in service["spec"]["ports"]} == set(names.values()), "ports of the service")
        policy = [item for item in self.all("NetworkPolicy") if item["metadata"]["name"] == "orbweave-coordinator"][0]
        allowed = {entry["port"] for rule in policy["spec"]["ingress"] for entry in rule["ports"]}
        want(allowed == set(names.values()), "ports of the network policy")
        budgets = [budget["spec"]["maxUnavailable"] for budget in self.all("PodDisruptionBudget")]
        want(budgets == ([] if option_of(args, "--journal") else [0]), "a budget where the journal is on the volume")

    def check_workers(self):
        service = self.all("Service")[0]["metadata"]["name"]
        listen = option_of(self.coordinator()["args"], "--listen").split(":")[1]
        for maker, (thing, template) in self.pods().items():
            container = template["spec"]["containers"][0]
            args = container["args"]
            if args[0] != "work":
                continue
            want(option_of(args, "--join") == f"{service}:{listen}", f"{maker}: --join")
            slots = int(option_of(args, "--slots"))
            tasks = slots * bytes_of(option_of(args, "--task-memory"))
            want(bytes_of(option_of(args, "--memory")) == tasks, f"{maker}: --memory is slots x --task-memory")
            memory = container["resources"]["requests"]["memory"]
            want(bytes_of(memory) == tasks + bytes_of(option_of(args, "--cache")), f"{maker}: requests {memory}")
            want(bytes_of(container["resources"]["limits"]["memory"]) >= bytes_of(memory), f"{maker}: limits")
            want(int(container["resources"]["requests"]["cpu"]) == slots, f"{maker}: a processor for each slot")
            want(template["spec"]["terminationGracePeriodSeconds"] > float(option_of(args, "--grace")),
                 f"{maker}: killed within --grace")
            if thing["kind"] == "ScaledJob":
                trigger = thing["spec"]["triggers"][0]["metadata"]
                http = option_of(self.coordinator()["args"], "--http").split(":")[1]
                want(trigger["url"] == f"http://{service}:{http}/wanted", f"{maker}: {trigger['url']}")
                want(trigger["targetValue"] == str(slots), f"{maker}: slots of a worker")
                want(option_of(args, "--idle-exit") == "60", f"{maker}: ends when there is nothing to do")
                want(template["spec"]["restartPolicy"] == "Never", f"{maker}: restartPolicy")

    def check_certificates(self):
        certificates = {item["spec"]["secretName"]: item for item in self.all("Certificate")}
        if not certificates:
            return
        issuers = {item["metadata"]["name"] for item in self.all("Issuer")}
        for item in certificates.values():
            want(item["spec"]["issuerRef"]["name"] in issuers, "no such issuer")
        for maker, (_, template) in self.pods().items():
            spec = template["spec"]
            keys = [volume["secret"] for volume in spec["volumes"] if volume["name"] == "keys"][0]
            want(keys["secretName"] in certificates, f"{maker}: nobody makes {keys['secretName']}")
            items = {item["key"]: item["path"] for item in keys.get("items", [])}
            want(items == {"ca.crt": "ca.crt", "tls.crt": "own.crt", "tls.key": "own.key"}, f"{maker}: names of keys")
            certificate = certificates[keys["secretName"]]["spec"]
            args = spec["containers"][0]["args"]
            role = "coordinator" if args[0] == "serve" else "worker"
            uri = re.fullmatch(rf"orbweave://[a-z0-9]+/{role}/([a-z0-9]+)", certificate["uris"][0])
            want(len(certificate["uris"]) == 1 and uri, f"{maker}: {certificate['uris']}")
            if role == "worker":
                want(option_of(args, "--name") == f"{uri[1]}/$(POD_NAME)", f"{maker}: a name under its certificate's")
                want(certificate["usages"][0] == "client auth", f"{maker}: usages")
            else:
                want(self.all("Service")[0]["metadata"]["name"] in certificate["dnsNames"], f"{maker}: dnsNames")
                want(certificate["usages"][0] == "server auth", f"{maker}: usages")


def option_of(args, option):
    for arg in args:
        if arg.startswith(option + "="):
            return arg[len(option) + 1:]
    return None


def worker_of(manifests):
    return [template for _, template in manifests.pods().values()
            if template["spec"]["containers"][0]["args"][0] == "work"][0]["spec"]


def spoil_each(manifests):
    """Copies with one thing wrong each: the checks above are to find all of them."""

    def spoilt(what, change):
        copied = Manifests(copy.deepcopy(manifests.things))
        change(copied)
        return what, copied

    def pod(copied):
        return worker_of(copied)

    def container(copied):
        return worker_of(copied)["containers"][0]

    def replace(args, option, value):
        args[:] = [f"{option}={value}" if arg.startswith(option + "=") else arg for arg in args]

    yield spoilt("a misspelt field", lambda m: container(m).update(imagePullPolcy="Always"))
    yield spoilt("root", lambda m: pod(m)["securityContext"].update(runAsUser=0))
    yield spoilt("a root that can be written", lambda m: container(m)["securityContext"].update(readOnlyRootFilesystem=False))
    yield spoilt("a capability", lambda m: container(m)["securityContext"]["capabilities"].update(add=["NET_ADMIN"]))
    yield spoilt("no limits", lambda m: container(m)["resources"].pop("limits"))
    yield spoilt("too little memory", lambda m: container(m)["resources"]["requests"].update(memory="12Gi"))
    yield spoilt("more slots", lambda m: replace(container(m)["args"], "--slots", "8"))
    yield spoilt("an option that is none", lambda m: container(m)["args"].append("--idle-exits=3"))
    yield spoilt("another address", lambda m: replace(container(m)["args"], "--join", "coordinator:7000"))
    yield spoilt("a mount without a volume", lambda m: container(m)["volumeMounts"].append({"name": "x", "mountPath": "/x"}))
    yield spoilt("a grace too short", lambda m: pod(m).update(terminationGracePeriodSeconds=30))
    yield spoilt("two coordinators", lambda m: m.all("StatefulSet")[0]["spec"].update(replicas=2))
    yield spoilt("another port", lambda m: replace(m.coordinator()["args"], "--http", "0.0.0.0:9465"))
    yield spoilt("a service of nobody", lambda m: m.all("Service")[0]["spec"].update(selector={"orbweave.role": "x"}))
    yield spoilt("an unknown kind", lambda m: m.things.append({"apiVersion": "v1", "kind": "Pod", "metadata": {"name": "p"}}))
    yield spoilt("a text for a number", lambda m: m.all("StatefulSet")[0]["spec"].update(replicas="1"))


def main():
    orbweave = sys.argv[1]
    helps = {command: subprocess.run([orbweave, command, "--help"], capture_output=True, text=True, check=True).stdout
             for command in ("serve", "work")}
    rules = yaml.safe_load((ROOT / "prometheus/alerts.yaml").read_text())
    copied = yaml.safe_load((KUBERNETES / "components/prometheus/rules.yaml").read_text())
    failed = []
    if copied["spec"] != rules:
        failed.append("components/prometheus/rules.yaml has other groups than deploy/prometheus/alerts.yaml")
    has_kustomize = kustomize_version() >= 5
    if not has_kustomize:
        print("no kubectl with Kustomize 5: rendered by this test alone", file=sys.stderr)

    rendered = {}
    for folder in [KUBERNETES / "base", *sorted((KUBERNETES / "overlays").iterdir())]:
        try:
            rendered[folder.name] = Manifests(in_order(render(folder)))
            rendered[folder.name].check(helps)
        except Wrong as error:
            failed.append(f"{folder.name}: {error}")
            continue
        if has_kustomize:
            result = subprocess.run(["kubectl", "kustomize", str(folder)], capture_output=True, text=True, check=False)
            if in_order(yaml.safe_load_all(result.stdout)) != rendered[folder.name].things:
                failed.append(f"{folder.name}: Kustomize makes something else of it {result.stderr}")
    for overlay, manifests in rendered.items():
        images = {template["spec"]["containers"][0]["image"] for _, template in manifests.pods().values()}
        if len(images) != 1 or images == {"orbweave"}:
            failed.append(f"{overlay}: images {images}")
    if not failed:
        for what, manifests in spoil_each(rendered["base"]):
            try:
                manifests.check(helps)
                failed.append(f"nothing was said of {what}")
            except Wrong as error:
                print(f"{what}: {error}")
        fixed = {"--idle-exit=60", "--patience=600"}
        ours, theirs = (worker_of(rendered[overlay])["containers"][0] for overlay in ("base", "keda"))
        if [arg for arg in theirs["args"] if arg not in fixed] != ours["args"] or ours["resources"] != theirs["resources"]:
            failed.append("workers of the overlay keda are not those of the base")
    components = {item.name for item in (KUBERNETES / "components").iterdir()}
    if not components < set(rendered):
        failed.append(f"no overlay has {components - set(rendered)}")
    for line in failed:
        print(line, file=sys.stderr)
    print(f"{len(rendered)} of base and overlays are as they should be" if not failed else "failed")
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
